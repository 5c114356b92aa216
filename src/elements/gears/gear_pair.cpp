// SPDX-License-Identifier: BSD-3-Clause
#include "elements/gears/gear_pair.hpp"

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <utility>

#include "base/text.hpp"
#include "elements/common/building.hpp"
#include "elements/gears/contact_channels.hpp"
#include "elements/gears/gear_bearings.hpp"
#include "elements/gears/gear_place.hpp"
#include "elements/gears/gear_report.hpp"
#include "elements/gears/tooth_phases.hpp"
#include "math/angle.hpp"

namespace engrane::elements::gears {

namespace {

std::vector<Channel> pair_channels() {
  using namespace dimension;
  std::vector<Channel> list{{"NORMAL_FORCE", force, "normal tooth force, positive where A drives"}};
  for (const char* wheel : {"A", "B"}) {
    const std::string w(wheel), of = " on wheel " + w;
    list.push_back({"TANGENTIAL_FORCE_" + w, force, "tooth force" + of + " along its positive sense of turning"});
    list.push_back({"RADIAL_FORCE_" + w, force, "tooth force" + of + " towards its axle"});
    list.push_back({"AXIAL_FORCE_" + w, force, "tooth force" + of + " along its axle"});
    list.push_back({"TORQUE_" + w, moment, "moment of the tooth forces" + of + " about its axle"});
  }
  add_force_channels(list, {"wheel A", "wheel B"});
  list.push_back({"PSI_A", angle, "turn of wheel A relative to the pair's frame, whole turns included"});
  list.push_back({"PSI_B", angle, "turn of wheel B relative to the pair's frame, whole turns included"});
  return list;
}

}  // namespace

GearPair::GearPair(int id, std::array<int, 2> nodes, const GearDesign& design, const PitchFrames& frames, const ToothLaw& teeth,
                   const ContactOptions& options, double width)
    : ToothedPair(id, nodes, ToothContact(contact_geometry(design, frames, width), teeth, options),
                  {{{"PSI_A", dimension::angle, "turn of wheel A relative to the pair's frame"},
                    {"PSI_B", dimension::angle, "turn of wheel B relative to the pair's frame"}}},
                  2, pair_channels()),
      design_(design),
      frames_(frames),
      triad_{frames.mu, frames.xi},
      tooth_{tooth_axes(design.cone[0], design.helix[0]), mating_tooth_axes(design.cone[1], design.helix[1])},
      radius_{design.radius(0), design.radius(1)} {}

ContactGeometry contact_geometry(const GearDesign& design, const PitchFrames& frames, double width) {
  ContactGeometry g = contact_geometry(design, width);
  g.turn_ratio = -design.lever(0) / design.lever(1);
  const Vec3 speed_a = design.radius(0) * frames.mu.col(2), speed_b = g.turn_ratio * design.radius(1) * frames.xi.col(2);
  // for parallel or intersecting axles the wheels roll, and any slip is rounding error
  if (const double slip = (speed_a - speed_b).norm(); slip > 1e-9 * speed_a.norm()) g.slip_per_turn = slip;
  return g;
}

ContactGeometry contact_geometry(const GearDesign& design, double width) {
  ContactGeometry g;
  g.pressure_angle = design.pressure_angle;
  g.transverse_pressure_angle = design.transverse_pressure_angle(0);
  g.helix = design.helix[0];
  g.teeth = design.teeth[0];
  g.radius = design.radius(0);
  g.width = width;
  g.reach = design.cut ? design.cut->tip_overlap() : 2 * design.normal_module;
  const int kind = design.parallel_kind();
  if (kind == 0) {
    // intersecting axles: the virtual wheels at the middle of the face (Tredgold), which roll as the cones do
    if (contact_ratio(design)) {
      g.base_pitch = std::numbers::pi * design.transverse_module(0) * std::cos(g.transverse_pressure_angle);
      g.approach = virtual_path_of_contact(design, 1).value_or(0);
      g.recess = virtual_path_of_contact(design, 0).value_or(0);
    }
    return g;
  }
  g.side = g.axle_sense = kind > 0 ? 1 : -1;
  const double c = std::cos(g.transverse_pressure_angle);
  const double sign_a = kind == -2 ? -1 : 1, sign_b = kind == -1 ? -1 : 1;
  g.base_radii = c * (sign_a * design.radius(0) + sign_b * design.radius(1));
  g.center_distance = std::abs(g.base_radii) / c;
  g.base_pitch = std::numbers::pi * design.transverse_module(0) * c;
  g.approach = path_of_contact(design, 1).value_or(0);
  g.recess = path_of_contact(design, 0).value_or(0);
  if (design.cut) {  // half the tooth thickness of A at the working pitch circle, over the pitch there
    const double r = design.radius(0);
    g.flank = design.cut->thickness_at(0, r) * design.teeth[0] / (4 * std::numbers::pi * r);
  }
  return g;
}

void GearPair::count_turns(const State& state, std::span<double> scalars, std::span<double> history) const {
  for (std::size_t i = 0; i < 2; ++i) {
    const double turns = std::round(state.scalars[i] / whole_turn);
    scalars[i] = state.scalars[i] - turns * whole_turn;
    history[i] = state.history[i] + turns;
  }
}

double GearPair::counted_phase(std::span<const double> history) const {
  return whole_turn * (design_.teeth[0] * history[0] + design_.teeth[1] * history[1]);
}

template <class T>
ToothedSide<T> GearPair::wheel(std::size_t i, const Mat3T<T>& R, const T& psi) const {
  return toothed_wheel(triad_[i], tooth_[i], radius_[i], R, psi);
}

template <class T>
void GearPair::mesh(const Motion<T, 2>& motion, const State& state, Balance<T, 2>& balance, ContactReport* report) const {
  const T &psi_a = motion.scalar[0], &psi_b = motion.scalar[1];
  const ToothedSide<T> a = wheel(0, motion.node[0].R, psi_a), b = wheel(1, motion.node[1].R, psi_b);
  const double pitch = design_.normal_module / 2;
  const T closing = -pitch * (design_.teeth[0] * psi_a + design_.teeth[1] * psi_b + counted_phase(state.history));
  ToothLoads<T> loads;
  const T normal_force =
      contact_.act(motion, a, b, closing, balance, this->grip(psi_a, state.history[0], state, balance), loads, report);
  // a change of ψ is the turn −δψ of the wheel's frame about its axle (18)
  balance.scalar(0, contact_.cos_alpha() * design_.lever(0) * normal_force + dot(a.axle, loads.frame_moment[0]));
  balance.scalar(1, contact_.cos_alpha() * design_.lever(1) * normal_force + dot(b.axle, loads.frame_moment[1]));
}

void GearPair::observe(const State& state, std::span<double> values) const {
  ChannelWriter out(values);
  const ContactReport on = report(state);
  out.put(state.multipliers[0]);
  std::array<Vec3, 2> point;
  std::array<double, 2> power{};  // given by the teeth to each wheel, in the pair's frame
  for (std::size_t i = 0; i < 2; ++i) {
    const NodeState& node = state.nodes[i];
    const auto w = wheel(i, node.R, state.scalars[i]);
    point[i] = node.x + w.arm;
    const Vec3 outward = w.arm / radius_[i], forward = cross(w.axle, outward);
    const double torque = on.moment[i].dot(w.axle);
    out.put(on.force[i].dot(forward));
    out.put(-on.force[i].dot(outward));
    out.put(on.force[i].dot(w.axle));
    out.put(torque);
    power[i] = torque * state.scalar_rates[i];
  }
  put_force_channels(out, on, 0.5 * (point[0] + point[1]));
  for (std::size_t i = 0; i < 2; ++i) out.put(state.scalars[i] + whole_turn * state.history[i]);
  put_contact_channels(out, contact_, on, power, state.scalars);
}

template class ToothedPair<GearPair>;

std::vector<Derived> GearPair::derived() const {
  return gear_report(design_, frames_, contact_.law(), contact_.geometry().width);
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
                     std::to_string(design_.teeth[i]) + R"(, "module": )" + format_number(design_.cut_module()) +
                     R"(, "width": )" + format_number(contact_.geometry().width));
    if (design_.cut) shapes.back() += drawn_cut(*design_.cut, i, radius_[i]);
  }
  return shapes;
}

namespace {

std::unique_ptr<Element> build_gear_pair(const GearData& data, BuildContext& context) {
  warn_of_radians(data.pressure_angle, context);
  const auto placement = place_gear(data, context);
  if (!placement) return nullptr;
  const GearDesign& design = placement->design;
  const int kind = design.parallel_kind();
  const double width = data.width.value_or(10 * design.cut_module());
  TeethOwner owner;
  owner.nodes = data.nodes;
  owner.axle = {placement->frames.mu.col(0), placement->frames.xi.col(0)};
  owner.teeth = design.teeth;
  owner.ring = {kind == -2, kind == -1};
  owner.lever = {design.lever(0), design.lever(1)};
  owner.parallel = kind != 0;
  owner.path_known = owner.parallel || contact_ratio(design);
  owner.geometry = contact_geometry(design, placement->frames, width);
  owner.cut = design.cut;
  if (!check_bearings(data.nodes, owner.axle, context)) return nullptr;
  const auto mesh = mesh_phase(context, data.stiffness || data.course.is("ISO"));
  if (!mesh) return nullptr;
  owner.mesh = *mesh;
  const auto teeth = read_teeth(data, owner, context);
  if (!teeth) return nullptr;
  return std::make_unique<GearPair>(context.record.id, data.nodes, design, placement->frames, teeth->law, teeth->options, width);
}

}  // namespace

ElementType gear_pair_type() { return element_type(gear_card(), build_gear_pair, 1, place_second_wheel); }

}  // namespace engrane::elements::gears
