// SPDX-License-Identifier: BSD-3-Clause
#include "elements/gear_pair.hpp"

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <utility>

#include "base/text.hpp"
#include "elements/building.hpp"
#include "elements/gear_place.hpp"

namespace engrane {

namespace {

constexpr double turn = 2 * std::numbers::pi;

std::vector<Named> channel_list(bool elastic) {
  using namespace dimension;
  std::vector<Named> list{{"NORMAL_FORCE", force, "normal tooth force, positive where A drives"}};
  for (const char* wheel : {"A", "B"}) {
    const std::string w(wheel), of = " on wheel " + w;
    list.push_back({"TANGENTIAL_FORCE_" + w, force, "tooth force" + of + " along its positive sense of turning"});
    list.push_back({"RADIAL_FORCE_" + w, force, "tooth force" + of + " towards its axle"});
    list.push_back({"AXIAL_FORCE_" + w, force, "tooth force" + of + " along its axle"});
    list.push_back({"TORQUE_" + w, moment, "moment of the tooth forces" + of + " about its axle"});
  }
  for (const char* wheel : {"A", "B"})
    for (const char* kind : {"FORCE", "MOMENT"})
      for (const char* component : {"X", "Y", "Z"}) {
        const bool is_force = kind[0] == 'F';
        list.push_back({std::string(kind) + "_" + wheel + component, is_force ? force : moment,
                        std::string(is_force ? "tooth force" : "moment of the tooth forces about the centre") + " on wheel " +
                            wheel + ", global " + component});
      }
  for (const char* component : {"X", "Y", "Z"})
    list.push_back({std::string("CONTACT_") + component, length, std::string("contact point, global ") + component});
  list.push_back({"PSI_A", angle, "turn of wheel A relative to the pair's frame, whole turns included"});
  list.push_back({"PSI_B", angle, "turn of wheel B relative to the pair's frame, whole turns included"});
  if (elastic) {
    list.push_back({"U_M", length, "tooth deformation and play along the circumference, u_m"});
    list.push_back({"TRANSMISSION_ERROR", length, "approach of the teeth, u_m + x_err"});
    list.push_back({"CONTACT", none, "contact: 1 where A drives, -1 on the other flank, 0 apart"});
  }
  return list;
}

Vec3 vector_at(std::span<const double> values, std::size_t first) {
  return {values[first], values[first + 1], values[first + 2]};
}

}  // namespace

GearPair::GearPair(int id, std::array<int, 2> nodes, const GearDesign& design, const PitchFrames& frames, const ToothLaw& teeth,
                   Options options)
    : TemplatedElement(id),
      design_(design),
      frames_(frames),
      teeth_(teeth),
      options_(options),
      triad_{frames.mu, frames.xi},
      tooth_{tooth_axes(design.cone[0], design.helix[0]), mating_tooth_axes(design.cone[1], design.helix[1])},
      radius_{design.radius(0), design.radius(1)},
      cos_alpha_(std::cos(design.pressure_angle)),
      sin_alpha_(std::sin(design.pressure_angle)),
      channels_(channel_list(teeth.stiffness > 0)) {
  Layout layout;
  layout.nodes = {nodes[0], nodes[1]};
  layout.needs = {NodeNeed::both, NodeNeed::both};
  layout.scalars = {{"PSI_A", dimension::angle, "turn of wheel A relative to the pair's frame"},
                    {"PSI_B", dimension::angle, "turn of wheel B relative to the pair's frame"}};
  if (elastic()) layout.scalars.push_back({"U_M", dimension::length, "tooth deformation along the circumference"});
  layout.multipliers = {{"TOOTH", dimension::length, "tooth contact, phi_1: its multiplier is the normal force"},
                        {"MESH", dimension::length, "contact points along the circumference, phi_2"},
                        {"TRIAD", dimension::angle, "tooth triads about the tooth, phi_3"}};
  layout.history = 2;
  set_layout(std::move(layout));
}

void GearPair::start(std::span<double> scalars, std::span<double> history) const {
  std::fill(scalars.begin(), scalars.end(), 0.0);
  std::fill(history.begin(), history.end(), 0.0);
}

void GearPair::commit(const State& state, std::span<double> scalars, std::span<double> history) const {
  for (std::size_t i = 0; i < 2; ++i) {
    const double turns = std::round(state.scalars[i] / turn);
    scalars[i] = state.scalars[i] - turns * turn;
    history[i] = state.history[i] + turns;
  }
}

double GearPair::counted_phase(std::span<const double> history) const {
  return turn * (design_.teeth[0] * history[0] + design_.teeth[1] * history[1]);
}

template <class T>
GearPair::Wheel<T> GearPair::wheel(std::size_t i, const Mat3T<T>& R, const T& psi) const {
  using std::cos, std::sin;
  const Mat3& triad = triad_[i];
  const Mat3& Y = tooth_[i];
  const T c = cos(psi), s = sin(psi);
  const Vec3T<T> turned_2 = rotate(R, Vec3(triad.col(1))), turned_3 = rotate(R, Vec3(triad.col(2)));  // (4)
  Wheel<T> w;
  w.axle = rotate(R, Vec3(triad.col(0)));
  Vec3T<T> e_2, e_3;  // (16)
  for (int k = 0; k < 3; ++k) {
    e_2[k] = turned_2[k] * c - turned_3[k] * s;
    e_3[k] = turned_2[k] * s + turned_3[k] * c;
    w.radius[k] = radius_[i] * e_2[k];
    w.eta_2[k] = Y(0, 1) * w.axle[k] + Y(1, 1) * e_2[k] + Y(2, 1) * e_3[k];
    w.eta_3[k] = Y(0, 2) * w.axle[k] + Y(1, 2) * e_2[k] + Y(2, 2) * e_3[k];
  }
  return w;
}

template <class T>
void GearPair::evaluate(const Motion<T, 2>& motion, const State& state, Balance<T, 2>& balance) const {
  using std::abs;
  const T &psi_a = motion.scalar[0], &psi_b = motion.scalar[1];
  const Wheel<T> a = wheel(0, motion.node[0].R, psi_a), b = wheel(1, motion.node[1].R, psi_b);
  const double lever_a = design_.lever(0), lever_b = design_.lever(1);

  // (21) with the sign of external contact, (22) and (23) for both wheels alike
  const double pitch = design_.normal_module / 2;
  T approach_of_flanks = -pitch * (design_.teeth[0] * psi_a + design_.teeth[1] * psi_b + counted_phase(state.history));
  if (elastic()) approach_of_flanks += motion.scalar[2];
  const T force_1 = balance.constraint(0, cos_alpha_ * approach_of_flanks);
  Vec3T<T> gap, normal, across;  // x_C^A − x_C^B (10), means of η₃ and η₂
  for (int k = 0; k < 3; ++k) {
    gap[k] = motion.node[0].x[k] - motion.node[1].x[k] + a.radius[k] - b.radius[k];
    normal[k] = 0.5 * (a.eta_3[k] + b.eta_3[k]);
    across[k] = 0.5 * (a.eta_2[k] + b.eta_2[k]);
  }
  const T force_2 = balance.constraint(1, dot(gap, normal));
  const T moment_3 = balance.constraint(2, 0.5 * (dot(a.eta_2, b.eta_3) - dot(a.eta_3, b.eta_2)));

  // The gradients (24)–(26). A small turn θ of a wheel's frame changes its radius and η by θ ×; a change of ψ is the turn
  // −δψ about the axle (18). So each wheel's ψ row is the moment about its axle, reversed.
  const T separating = options_.separation ? T(-sin_alpha_ * abs(force_1)) : T(0);
  const Vec3T<T> lateral_a = cross(a.eta_3, gap), lateral_b = cross(b.eta_3, gap);
  const Vec3T<T> triads_a = cross(a.eta_2, b.eta_3), triads_b = cross(a.eta_3, b.eta_2);
  Vec3T<T> along, radial, arm_a, arm_b, frame_a, frame_b;
  for (int k = 0; k < 3; ++k) {
    along[k] = force_2 * normal[k];
    radial[k] = separating * across[k];  // F^A of (34)
    arm_a[k] = a.radius[k] - 0.5 * gap[k];
    arm_b[k] = b.radius[k] + 0.5 * gap[k];
  }
  const Vec3T<T> along_a = cross(a.radius, along), along_b = cross(b.radius, along);
  for (int k = 0; k < 3; ++k) {
    const T couple = 0.5 * moment_3 * (triads_a[k] - triads_b[k]);
    frame_a[k] = along_a[k] + 0.5 * force_2 * lateral_a[k] + couple;
    frame_b[k] = -along_b[k] + 0.5 * force_2 * lateral_b[k] - couple;
  }
  // (35), at the point midway between the two contact points; it does no work on ψ
  const Vec3T<T> moment_a = frame_a + cross(arm_a, radial), moment_b = frame_b - cross(arm_b, radial);
  balance.force(0, -(along + radial));
  balance.force(1, along + radial);
  balance.moment(0, -rotate_back(motion.node[0].R, moment_a));
  balance.moment(1, -rotate_back(motion.node[1].R, moment_b));
  balance.scalar(0, cos_alpha_ * lever_a * force_1 + dot(a.axle, frame_a));
  balance.scalar(1, cos_alpha_ * lever_b * force_1 + dot(b.axle, frame_b));

  if (!elastic()) return;
  const Function::Jet error = teeth_.error.at(value_of(psi_a));
  const T x = motion.scalar[2] + compose(psi_a, error.f, error.d1, error.d2);
  const T spring = teeth_.elastic_force(x);
  balance.scalar(0, spring * compose(psi_a, error.d1, error.d2, error.d3));  // (29)
  balance.scalar(2, spring + teeth_.damping_force(x, motion.scalar_rate[2]) - cos_alpha_ * force_1);
}

double GearPair::approach(const State& state) const { return state.scalars[2] + teeth_.error.at(state.scalars[0]).f; }

Energies GearPair::energies(const State& state) const {
  Energies e;
  if (elastic()) {
    const double x = approach(state), rate = state.scalar_rates[2];
    e.potential = teeth_.potential(x);
    e.dissipated = teeth_.damping_force(x, rate) * rate;
  }
  if (options_.separation) {
    // What the separating force gives to the wheels: nothing while the centres keep their distance.
    const NodeState &node_a = state.nodes[0], &node_b = state.nodes[1];
    const auto a = wheel(0, node_a.R, state.scalars[0]), b = wheel(1, node_b.R, state.scalars[1]);
    const Vec3 gap = node_a.x - node_b.x + a.radius - b.radius;
    const Vec3 force = -0.5 * sin_alpha_ * std::abs(state.multipliers[0]) * (a.eta_2 + b.eta_2);
    const Vec3 v_a = node_a.v + cross(Vec3(node_a.R * node_a.W), Vec3(a.radius - 0.5 * gap));
    const Vec3 v_b = node_b.v + cross(Vec3(node_b.R * node_b.W), Vec3(b.radius + 0.5 * gap));
    e.external = force.dot(v_a - v_b);
  }
  return e;
}

void GearPair::observe(const State& state, std::span<double> values) const {
  std::vector<double> r(static_cast<std::size_t>(layout().slots()));
  residual(state, r);
  std::size_t next = 0;
  const auto put = [&](double value) { values[next++] = value; };
  const auto put_vector = [&](const Vec3& v) {
    for (int k = 0; k < 3; ++k) put(v[k]);
  };

  put(state.multipliers[0]);
  std::array<Vec3, 2> force, moment, point;
  for (std::size_t i = 0; i < 2; ++i) {
    const NodeState& node = state.nodes[i];
    const auto w = wheel(i, node.R, state.scalars[i]);
    force[i] = -vector_at(r, 6 * i);  // the residual is what the element resists with
    moment[i] = -(node.R * vector_at(r, 6 * i + 3));
    point[i] = node.x + w.radius;
    const Vec3 outward = w.radius / radius_[i], forward = cross(w.axle, outward);
    put(force[i].dot(forward));
    put(-force[i].dot(outward));
    put(force[i].dot(w.axle));
    put(moment[i].dot(w.axle));
  }
  for (std::size_t i = 0; i < 2; ++i) {
    put_vector(force[i]);
    put_vector(moment[i]);
  }
  put_vector(0.5 * (point[0] + point[1]));
  for (std::size_t i = 0; i < 2; ++i) put(state.scalars[i] + turn * state.history[i]);
  if (elastic()) {
    const double x = approach(state);
    put(state.scalars[2]);
    put(x);
    put(teeth_.contact(x));
  }
}

std::vector<Derived> GearPair::derived() const {
  using namespace dimension;
  std::vector<Derived> list;
  const Mat3 Z = wheel_to_wheel(design_);
  const auto each = [&](const std::string& name, Dimension d, auto value) {
    list.push_back({name + " of wheel A", value(std::size_t{0}), d});
    list.push_back({name + " of wheel B", value(std::size_t{1}), d});
  };
  each("pitch radius", length, [&](std::size_t i) { return radius_[i]; });
  each("base radius", length, [&](std::size_t i) { return radius_[i] * std::cos(design_.transverse_pressure_angle(i)); });
  each("transverse module", length, [&](std::size_t i) { return design_.transverse_module(i); });
  each("transverse pressure angle", angle, [&](std::size_t i) { return design_.transverse_pressure_angle(i); });
  each("cone angle", angle, [&](std::size_t i) { return design_.cone[i]; });
  each("helix angle (right hand > 0)", angle, [&](std::size_t i) { return paper_helix(design_.helix[i], design_.cone[i]); });
  for (int k = 0; k < 3; ++k) list.push_back({std::string("axle of wheel B, ") + "xyz"[k], frames_.xi(k, 0), none});
  for (int k = 0; k < 3; ++k) list.push_back({std::string("contact point, ") + "xyz"[k], frames_.contact[k], length});
  const Vec3 span = radius_[0] * frames_.mu.col(1) - radius_[1] * frames_.xi.col(1);
  list.push_back({"distance of the centres", span.norm(), length});
  list.push_back({"angle between the axles", std::atan2(std::hypot(Z(1, 0), Z(2, 0)), std::abs(Z(0, 0))), angle});
  list.push_back({"ratio z_B/z_A", static_cast<double>(design_.teeth[1]) / design_.teeth[0], none});
  list.push_back({"teeth met per turn of wheel A", static_cast<double>(design_.teeth[0]), none});
  if (const auto ratio = contact_ratio(design_)) list.push_back({"transverse contact ratio", *ratio, none});
  if (elastic()) {
    list.push_back({"tooth stiffness", teeth_.stiffness, dimension::stiffness});
    list.push_back({"tooth damping", teeth_.damping, dimension::damping});
    if (teeth_.backlash > 0) list.push_back({"onset of contact", teeth_.onset, length});
  }
  return list;
}

Drawing GearPair::drawing() const {
  Drawing shapes;
  for (std::size_t i = 0; i < 2; ++i) {
    const Vec3 toward = triad_[i].col(1);
    const Vec3 center = frames_.contact - radius_[i] * toward;
    shapes.push_back(R"("shape": "wheel", "node": )" + std::to_string(layout().nodes[i]) + R"(, "center": )" + json(center) +
                     R"(, "axis": )" + json(Vec3(triad_[i].col(0))) + R"(, "toward": )" + json(toward) + R"(, "radius": )" +
                     format_number(radius_[i]) + R"(, "cone": )" + format_number(design_.cone[i] / degree) + R"(, "helix": )" +
                     format_number(paper_helix(design_.helix[i], design_.cone[i]) / degree) + R"(, "teeth": )" +
                     std::to_string(design_.teeth[i]) + R"(, "module": )" + format_number(design_.normal_module) +
                     R"(, "width": )" + format_number(options_.width > 0 ? options_.width : 10 * design_.normal_module));
  }
  return shapes;
}

namespace {

std::unique_ptr<Element> build_gear_pair(const GearData& data, BuildContext& context) {
  const auto placement = place_gear(data, context);
  if (!placement) return nullptr;
  const GearDesign& design = placement->design;
  const TeethOwner owner{
      data.nodes, {placement->frames.mu.col(0), placement->frames.xi.col(0)}, design.teeth, {design.lever(0), design.lever(1)}};
  const auto teeth = tooth_law(data, owner, context);
  if (!teeth) return nullptr;
  return std::make_unique<GearPair>(context.record.id, data.nodes, design, placement->frames, *teeth,
                                    GearPair::Options{!data.separation.is("NO"), data.width.value_or(0)});
}

}  // namespace

ElementType gear_pair_type() { return element_type(gear_card(), build_gear_pair, 1); }

}  // namespace engrane
