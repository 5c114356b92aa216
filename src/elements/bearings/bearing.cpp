// SPDX-License-Identifier: BSD-3-Clause
#include "elements/bearings/bearing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <numbers>
#include <numeric>

#include "elements/bearings/rolling_elements.hpp"
#include "elements/bearings/speed_matrices.hpp"
#include "elements/common/held_point.hpp"
#include "elements/common/law_corners.hpp"
#include "elements/common/material.hpp"
#include "model/determined_channels.hpp"
#include "model/templated_element.hpp"

namespace engrane::elements::bearings {

namespace {

/// Forces as functions of the displacement of the shaft's point in the housing's axes: speed-dependent matrices and rolling
/// elements.
///
/// Coordinates: displacements 1 to 3, and the tilts of the shaft's axis n about 2 and 3, θ₂ = −n₃ and θ₃ = n₂. The fourth
/// coordinate, the spin, has a rate only.
class Bearing final : public TemplatedElement<Bearing, 2, 12>, public DeterminedChannels {
 public:
  struct Parts {
    SpeedMatrices stiffness, damping;
    std::shared_ptr<const RollingElements> rolling;  ///< nullptr: matrices only
  };

  Bearing(int id, const HeldPoint& place, Parts parts)
      : TemplatedElement(id),
        place_(place),
        parts_(std::move(parts)),
        corners_(parts_.stiffness.varies() ? parts_.stiffness.corners() : parts_.damping.corners()) {
    // the first matrix stores energy; differences of the other matrices from it do work like damping
    if (!parts_.stiffness.empty()) {
      const Mat6& first = parts_.stiffness.values().front();
      stored_ = 0.5 * (first + first.transpose());
    }
    Layout layout;
    layout.nodes.assign(place.nodes.begin(), place.nodes.end());
    layout.needs = {NodeNeed::both, NodeNeed::both};
    if (parts_.rolling) {
      layout.switches = {{"rolling elements take load", "rolling elements are without load"}};
      for (int i = 1; i <= parts_.rolling->count(); ++i) {
        const std::string which = fmt::format("{} {}", parts_.rolling->balls() ? "ball" : "roller", i);
        // others carry as well: their forces grow from zero, which steps of fixed length do not notice
        layout.switches.push_back({which + " takes load", which + " is without load", true});
      }
    }
    corners_.name(layout.switches, "SPEED");
    set_layout(std::move(layout));
  }

  template <class T>
  void evaluate(const Motion<T, 2>& motion, const State&, Balance<T, 2>& balance) const {
    const Place<T> place = this->place(motion);
    const std::array<T, 6> load = this->load(place, balance.contact_homotopy());
    HeldPoint::resist(place.shift, Vec3T<T>(load[0], load[1], load[2]), moment(place, load), motion, balance);
  }

  Energies energies(const State& state) const override {
    const Place<double> place = this->place(motion<double>(state));
    const Vec6 q = Eigen::Map<const Vec6>(place.q.data()), rate = Eigen::Map<const Vec6>(place.rate.data());
    Energies e;
    e.potential = 0.5 * q.dot(stored_ * q);
    if (parts_.rolling) e.potential += parts_.rolling->energy(five(place.q));
    const std::array<double, 6> elastic = parts_.stiffness.times(place.q, place.rate[spin]),
                                damped = parts_.damping.times(place.rate, place.rate[spin]);
    e.dissipated = rate.dot(Eigen::Map<const Vec6>(elastic.data()) - stored_ * q + Eigen::Map<const Vec6>(damped.data()));
    return e;
  }

  void switches(const State& state, std::span<Switch> values) const override {
    if (values.empty()) return;
    const Place<double> place = this->place(motion<double>(state));
    std::size_t next = 0;
    if (parts_.rolling) {
      const RollingElements::Five<double> rate = five(place.rate);
      const auto put = [&](const RollingElements::Touch<double>& touch) {
        const double speed = std::inner_product(rate.begin(), rate.end(), touch.gradient.begin(), 0.0);
        values[next++] = {touch.penetration, speed, parts_.rolling->size()};
      };
      const auto all = parts_.rolling->deepest(five(place.q));
      put(*std::max_element(all.begin(), all.end(), [](auto& x, auto& y) { return x.penetration < y.penetration; }));
      std::for_each(all.begin(), all.end(), put);
    }
    const NodeState &a = state.nodes[0], &b = state.nodes[1];
    const Vec3 axis = place.shift.axes.col(0), turn = (a.R * a.W).cross(axis);
    const Taylor speed(place.rate[spin], turn.dot(place.shift.spin) + axis.dot(b.R * b.A - a.R * a.A), 0);
    corners_.switches(speed, state.time, std::abs(speed.value), values.subspan(next));
  }

  bool has_gaps() const override { return parts_.rolling != nullptr; }
  /// Whether the bearing as a whole does: elements between those with load and those without often touch.
  bool touches(const State& state) const override {
    std::vector<Switch> values(layout().switches.size());
    switches(state, values);
    return has_gaps() && values.front().unclear();
  }

  const std::vector<Channel>& channels() const override {
    static const std::vector<Channel> of_matrices = list(false), of_rolling = list(true);
    return parts_.rolling ? of_rolling : of_matrices;
  }

  void observe(const State& state, std::span<double> values) const override {
    const Place<double> place = this->place(motion<double>(state));
    const std::array<double, 6> load = this->load(place, 0);
    const Vec3 moment = this->moment(place, load);
    const Energies e = energies(state);
    std::size_t next = 0;
    for (const std::size_t i : {0, 1, 2, 4, 5}) values[next++] = place.q[i];
    values[next++] = place.rate[spin];
    for (const std::size_t i : {0, 1, 2}) values[next++] = -load[i];
    for (const Eigen::Index i : {0, 1, 2}) values[next++] = -moment[i];
    values[next++] = e.potential;
    values[next++] = e.dissipated;
    if (!parts_.rolling) return;
    const RollingElements::Loads loads = parts_.rolling->loads(five(place.q));
    values[next++] = loads.force;
    values[next++] = loads.pressure;
    values[next++] = loads.loaded;
  }

  /// Which ball carries most changes between two instants.
  std::vector<Determined> determined() const override {
    if (!parts_.rolling) return {};
    return {{largest_load, {0, 1, 2, 3, 4}}, {largest_load + 1, {0, 1, 2, 3, 4}}};
  }
  double determine(int channel, double, std::span<const double> coordinates) const override {
    RollingElements::Five<double> q{};
    std::copy_n(coordinates.begin(), q.size(), q.begin());
    const RollingElements::Loads loads = parts_.rolling->loads(q);
    return channel == largest_load ? loads.force : loads.pressure;
  }

  std::vector<Derived> derived() const override {
    if (!parts_.rolling) return {};
    return {{"CONTACT_ANGLE", parts_.rolling->contact_angle(), dimension::angle},
            {"PRELOAD_APPROACH", parts_.rolling->preload_approach(), dimension::length}};
  }

  Drawing drawing() const override { return place_.drawing(); }

 private:
  static constexpr std::size_t spin = 3;
  static constexpr int largest_load = 14;  ///< its channel; that of the largest pressure is next

  template <class T>
  struct Place {
    HeldPoint::Shift<T> shift;
    Vec3T<T> axis;  ///< of the shaft, in the bearing's axes
    std::array<T, 6> q, rate;
  };

  template <class T>
  Place<T> place(const Motion<T, 2>& motion) const {
    Place<T> p{place_.shift(motion), {}, {}, {}};
    const Vec3T<T> shaft = rotate(motion.node[1].R, Vec3(place_.axes.col(0)));
    p.axis = rotate_back(p.shift.axes, shaft);
    const Vec3T<T> turning = rotate_back(p.shift.axes, p.shift.spin), change = cross(turning, p.axis);
    p.q = {p.shift.value[0], p.shift.value[1], p.shift.value[2], T(0), -p.axis[2], p.axis[1]};
    p.rate = {p.shift.rate[0], p.shift.rate[1], p.shift.rate[2], turning[0], -change[2], change[1]};
    return p;
  }

  template <class T>
  std::array<T, 6> load(const Place<T>& place, double homotopy) const {
    std::array<T, 6> load = parts_.stiffness.times(place.q, place.rate[spin]);
    const std::array<T, 6> damped = parts_.damping.times(place.rate, place.rate[spin]);
    for (std::size_t i = 0; i < 6; ++i) load[i] += damped[i];
    if (parts_.rolling) {
      const RollingElements::Five<T> rolling = parts_.rolling->load(five(place.q), homotopy);
      for (std::size_t i = 0; i < 5; ++i) load[i < 3 ? i : i + 1] += rolling[i];
    }
    return load;
  }

  /// Moment in the bearing's axes: n × g from the tilts, with g·δn = m₂ δθ₂ + m₃ δθ₃, plus the moment about axis 1.
  template <class T>
  static Vec3T<T> moment(const Place<T>& place, const std::array<T, 6>& load) {
    Vec3T<T> m = cross(place.axis, Vec3T<T>(T(0), load[5], -load[4]));
    m[0] += load[spin];
    return m;
  }

  /// The coordinates without the spin.
  template <class T>
  static RollingElements::Five<T> five(const std::array<T, 6>& q) {
    return {q[0], q[1], q[2], q[4], q[5]};
  }

  static std::vector<Channel> list(bool rolling) {
    std::vector<Channel> all;
    const auto add = [&](const char* name, std::initializer_list<int> axes, Dimension dimension, const char* help) {
      for (const int axis : axes) all.push_back({fmt::format("{}_{}", name, axis), dimension, help});
    };
    add("DISPLACEMENT", {1, 2, 3}, dimension::length, "displacement of B's point from A's, in the bearing's axes: 1 is along it");
    add("TILT", {2, 3}, dimension::angle, "tilt of B's axis from A's, about the bearing's axes");
    all.push_back({"SPEED", dimension::angular_velocity, "speed of B relative to A about the axis"});
    add("FORCE", {1, 2, 3}, dimension::force, "force of the bearing on B, in its axes");
    add("MOMENT", {1, 2, 3}, dimension::moment, "moment of the bearing on B, at its point, in its axes");
    all.push_back({"SPRING_ENERGY", dimension::energy, "energy stored"});
    all.push_back({"DAMPER_POWER", dimension::power, "power lost"});
    if (rolling) {
      all.push_back({"ELEMENT_LOAD", dimension::force, "largest force on a ball or roller", Channel::Course::size});
      all.push_back({"CONTACT_PRESSURE", dimension::pressure, "largest pressure between a ball or roller and a ring",
                     Channel::Course::size});
      all.push_back({"LOADED_ELEMENTS", dimension::none, "number of balls or rollers that carry", Channel::Course::state});
    }
    return all;
  }

  HeldPoint place_;
  Parts parts_;
  LawCorners corners_;  ///< of the matrices over the speed
  Mat6 stored_ = Mat6::Zero();
};

constexpr Eigen::Index spin_row = 3;

/// One matrix from its radial block, diagonal, upper triangle, or all entries by rows.
std::optional<Mat6> matrix(std::span<const double> values) {
  if (values.size() == 4) {
    Mat6 m = Mat6::Zero();
    m.block<2, 2>(1, 1) << values[0], values[1], values[2], values[3];
    return m;
  }
  if (values.size() == 36) return Mat6(Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(values.data()));
  return symmetric_6(values);
}

/// The matrices of a keyword, one per speed. Returns nothing, with an error, if the values are invalid.
std::optional<SpeedMatrices> matrices(const BuildContext& context, const char* keyword, const std::vector<double>& values,
                                      const std::vector<double>& speeds, bool drags) {
  if (values.empty()) return SpeedMatrices();
  const std::size_t count = std::max<std::size_t>(speeds.size(), 1);
  const bool whole = values.size() % count == 0;
  std::vector<Mat6> all;
  for (std::size_t i = 0; whole && i < count; ++i)
    if (const auto m = matrix(std::span(values).subspan(i * (values.size() / count), values.size() / count))) all.push_back(*m);
  if (all.size() < count) {
    context.error(keyword,
                  fmt::format("{} has {} values for {} {}", keyword, values.size(), count, count == 1 ? "matrix" : "speeds"),
                  "for each speed give 4 (radial: 22 23 32 33), 6 (the diagonal), 21 (the upper triangle) or 36 (by rows)");
    return {};
  }
  for (const Mat6& m : all) {
    Mat6 about_axis = m;
    if (drags) about_axis(spin_row, spin_row) = 0;
    if (!about_axis.row(spin_row).isZero(0) || !about_axis.col(spin_row).isZero(0)) {
      context.error(keyword, fmt::format("{} resists rotation about the axis, which a bearing leaves free", keyword),
                    drags ? "only the fourth entry of the diagonal may be there: drag" : "the fourth row and column are 0");
      return {};
    }
    constexpr double rounding = 1e-9;
    if (m == m.transpose() && !m.isZero(0) && definiteness(m) < -rounding) {
      context.error(keyword, fmt::format("the matrix of {} is not positive: some motion would gain energy from it", keyword),
                    fmt::format("none of its eigenvalues may be negative: the least is {:.6g} times the largest in size, with "
                                "rows scaled to a unit diagonal",
                                definiteness(m)));
      return {};
    }
  }
  return SpeedMatrices(speeds, std::move(all));
}

/// Reports keywords that have no effect beside another; returns true if there are none.
template <class... Given>
bool none_of(const BuildContext& context, const char* beside, const Given&... given) {
  bool none = true;
  const auto look = [&](const auto& field) {
    if (!field.second) return;
    context.error(field.first, fmt::format("{} has no effect {}", field.first, beside), fmt::format("leave {} out", field.first));
    none = false;
  };
  (look(given), ...);
  return none;
}

using Given = std::pair<const char*, bool>;

bool needs(const BuildContext& context, const char* keyword, bool given, const char* who, const char* what) {
  if (!given) context.error(who, fmt::format("{} without {}", who, keyword), fmt::format("{}: {}", keyword, what));
  return given;
}

/// Whether the elements fit into the bearing.
bool fits(const BuildContext& context, const char* who, const RollingData& r) {
  const double gap = r.pitch_diameter * std::sin(std::numbers::pi / r.count) - r.diameter;
  const bool angular = r.contact_angle > 0;
  bool fits = true;
  const auto wrong = [&](const char* keyword, std::string message, std::string hint) {
    context.error(keyword, std::move(message), std::move(hint));
    fits = false;
  };
  if (r.diameter >= r.pitch_diameter)
    wrong("D", fmt::format("elements of {} are no smaller than their circle of {}", r.diameter, r.pitch_diameter),
          "D is the diameter of a ball or roller, DM that of the circle of their centres");
  else if (r.count > 1 && gap < 0)
    wrong(who, fmt::format("{} elements of {} overlap on a circle of {}", r.count, r.diameter, r.pitch_diameter),
          fmt::format("at most {}", std::floor(std::numbers::pi / std::asin(r.diameter / r.pitch_diameter))));
  if (r.preload > 0 && !angular && !r.balls)
    wrong("PRELOAD", "PRELOAD of cylindrical rollers, which take no thrust",
          "ALPHA the contact angle, or a CLEARANCE below zero");
  if (!r.balls) return fits;
  const double slack = (r.inner_conformity + r.outer_conformity - 1) * r.diameter;
  if (angular && r.clearance != 0)
    wrong("CLEARANCE", "CLEARANCE beside ALPHA: balls that touch at an angle have no play", "give one of them");
  if (std::abs(r.clearance) >= 2 * slack)
    wrong("CLEARANCE", fmt::format("a play of {} is more than the grooves allow", r.clearance),
          fmt::format("less than 2 (FI + FO - 1) D = {:.4g}", 2 * slack));
  return fits;
}

std::shared_ptr<const RollingElements> rolling(const BearingData& data, const BuildContext& context) {
  const bool balls = data.balls.has_value();
  const char* who = balls ? "BALLS" : "ROLLERS";
  bool good =
      needs(context, "D", data.diameter.has_value(), who, balls ? "diameter of a ball" : "diameter of a roller in its middle");
  good = needs(context, "DM", data.pitch_diameter.has_value(), who, "diameter of the circle of their centres") && good;
  good = needs(context, "MAT", data.material.has_value(), who, "number of a material of .MAT") && good;
  if (balls) {
    good = none_of(context, "beside BALLS", Given{"L", data.length.has_value()}, Given{"STRAIGHT", data.straight},
                   Given{"SLICES", data.slices.has_value()}) &&
           good;
  } else {
    good = needs(context, "L", data.length.has_value(), who, "length of a roller that carries") && good;
    good = none_of(context, "beside ROLLERS", Given{"FI", data.inner_conformity.has_value()},
                   Given{"FO", data.outer_conformity.has_value()}) &&
           good;
  }
  const deck::MaterialCard* material = data.material ? isotropic_material(context, *data.material, "bearings") : nullptr;
  if (!good || !material) return nullptr;
  RollingData r;
  r.balls = balls;
  r.count = balls ? *data.balls : *data.rollers;
  r.diameter = *data.diameter;
  r.pitch_diameter = *data.pitch_diameter;
  r.contact_angle = data.contact_angle.value_or(0) * degree;
  r.clearance = data.clearance.value_or(0);
  // largest values that ISO 281 permits for radial ball bearings
  r.inner_conformity = data.inner_conformity.value_or(0.52);
  r.outer_conformity = data.outer_conformity.value_or(0.53);
  r.length = data.length.value_or(0);
  r.crowned = !data.straight;
  r.slices = data.slices.value_or(r.slices);
  r.young = material->young.front();
  r.poisson = material->poisson.front();
  r.preload = data.preload.value_or(0);
  return fits(context, who, r) ? std::make_shared<RollingElements>(r) : nullptr;
}

std::unique_ptr<Element> build(const BearingData& data, BuildContext& context) {
  const bool good_nodes = check_nodes(context, {data.nodes[0], data.nodes[1]});
  const auto axes = axes_of(context, data.axis, data.axis_2);
  bool good = good_nodes && axes.has_value();
  for (std::size_t i = 1; i < data.speeds.size(); ++i)
    if (!(data.speeds[i] > data.speeds[i - 1])) {
      context.error("SPEED", fmt::format("SPEED {} follows {}", data.speeds[i], data.speeds[i - 1]),
                    "give speeds in ascending order");
      return nullptr;
    }
  const auto stiffness = matrices(context, "K", data.stiffness, data.speeds, false),
             damping = matrices(context, "C", data.damping, data.speeds, true);
  good = stiffness && damping && good;
  Bearing::Parts parts;
  if (data.balls || data.rollers) {
    good = none_of(context, data.balls ? "beside BALLS" : "beside ROLLERS", Given{"K", !data.stiffness.empty()},
                   Given{"ROLLERS", data.balls && data.rollers}) &&
           good;
    parts.rolling = rolling(data, context);
    good = parts.rolling && good;
  } else {
    good = none_of(context, "without BALLS or ROLLERS", Given{"D", data.diameter.has_value()},
                   Given{"DM", data.pitch_diameter.has_value()}, Given{"L", data.length.has_value()},
                   Given{"FI", data.inner_conformity.has_value()}, Given{"FO", data.outer_conformity.has_value()},
                   Given{"ALPHA", data.contact_angle.has_value()}, Given{"CLEARANCE", data.clearance.has_value()},
                   Given{"PRELOAD", data.preload.has_value()}, Given{"MAT", data.material.has_value()},
                   Given{"STRAIGHT", data.straight}, Given{"SLICES", data.slices.has_value()}) &&
           good;
    if (data.stiffness.empty() && data.damping.empty()) {
      context.error("N", "a bearing with neither rolling elements nor a matrix does nothing",
                    "BALLS n D d DM d MAT m, ROLLERS n D d DM d L l MAT m, or K k1 .. k6");
      return nullptr;
    }
  }
  if (!good) return nullptr;
  parts.stiffness = *stiffness;
  parts.damping = *damping;
  return std::make_unique<Bearing>(context.record.id, HeldPoint::of(context, data.nodes, data.at, *axes), std::move(parts));
}

}  // namespace

ElementType bearing_type() {
  deck::Card<BearingData> card("BEARING", {"ROULEMENT", "PALIER"}, "Bearing: balls, rollers, or stiffness and damping by speed");
  card.numbered()
      .chapter("Stiffeners, dampers, transfer functions")
      .describe(
          "Holds the shaft, node b, in the housing, node a, by forces, and lets it spin about AXIS. BALLS and ROLLERS are "
          "bearings "
          "from catalogue data: contacts of Hertz, clearance, preload and tilt, with the load of each ball or slice of a roller. "
          "K "
          "and C are matrices in the order: displacement along 1 (the axis), 2, 3, rotation about 1, 2, 3. Each has 4 values "
          "(radial only: 22 23 32 33), 6 (the diagonal), 21 (the upper triangle) or 36 (by rows, and need not be symmetric, as "
          "of "
          "oil films); the fourth row and column are 0, but C may have a drag there. With SPEED there are as many matrices as "
          "speeds, with straight lines between.")
      .example("I 7 BEARING N 1 2 AXIS 1 0 0  BALLS 9 D 12.7D-3 DM 65.D-3 CLEARANCE 15.D-6 MAT 1")
      .example("I 8 BEARING N 1 3 AXIS 0 0 1  BALLS 16 D 22.2D-3 DM 125.3D-3 ALPHA 40 PRELOAD 500. MAT 1")
      .example("I 9 BEARING N 1 4 AXIS 1 0 0  ROLLERS 14 D 10.D-3 L 9.6D-3 DM 54.D-3 MAT 1  C 0 200 200 0 0 0")
      .example("I 10 BEARING N 1 5 AXIS 0 0 1  SPEED 100 300  K 2D7 1D7 -1D7 2D7  3D7 2D7 -2D7 3D7  C 2D4 0 0 2D4  1D4 0 0 1D4");
  card.add("N", &BearingData::nodes, "a, the housing, and b, the shaft; 0 is the ground")
      .synonyms({"NODES", "NOEUDS"})
      .refers(deck::Reference::node)
      .required();
  card.add("AXIS", &BearingData::axis,
           "axis of the bearing, in the reference configuration; with ALPHA, the direction in which the shaft's thrust is taken")
      .synonyms({"AXE"})
      .required();
  card.add("AXIS2", &BearingData::axis_2,
           "across AXIS, towards axis 2, on which the first ball or roller is; default: any perpendicular")
      .synonyms({"AXE2"});
  card.add("AT", &BearingData::at, "middle of the bearing, in the reference configuration; default: at b")
      .unit(dimension::length);
  card.add("BALLS", &BearingData::balls, "number of balls").synonyms({"BILLES"}).at_least(1);
  card.add("ROLLERS", &BearingData::rollers, "number of rollers").synonyms({"ROULEAUX"}).at_least(1);
  card.add("D", &BearingData::diameter, "diameter of a ball, or of a roller in its middle").unit(dimension::length).positive();
  card.add("DM", &BearingData::pitch_diameter, "diameter of the circle of their centres").unit(dimension::length).positive();
  card.add("L", &BearingData::length, "length of a roller that carries").unit(dimension::length).positive();
  card.add("FI", &BearingData::inner_conformity, "radius of the inner ring's groove over D; default: 0.52").above(0.5).at_most(1);
  card.add("FO", &BearingData::outer_conformity, "radius of the outer ring's groove over D; default: 0.53").above(0.5).at_most(1);
  card.add("ALPHA", &BearingData::contact_angle, "contact angle; default: 0").unit(dimension::angle).at_least(0).below(90);
  card.add("CLEARANCE", &BearingData::clearance,
           "radial internal clearance: total play across the diameter; below 0 an interference; default: 0")
      .synonyms({"JEU"})
      .unit(dimension::length);
  card.add("PRELOAD", &BearingData::preload, "thrust that the bearing carries in the reference configuration; default: 0")
      .unit(dimension::force)
      .at_least(0);
  card.add("MAT", &BearingData::material, "number of the material of rings and rolling elements in `.MAT`")
      .synonyms({"MATERIAL", "MATERIAU"});
  card.add("STRAIGHT", &BearingData::straight, "rollers without the profile of ISO/TS 16281");
  card.add("SLICES", &BearingData::slices, "slices that a roller is cut into; default: 30").at_least(1).at_most(1000);
  card.add("K", &BearingData::stiffness, "stiffness: for each speed 4, 6, 21 or 36 values").values(4, 100000);
  card.add("C", &BearingData::damping, "damping: for each speed 4, 6, 21 or 36 values").values(4, 100000);
  card.add("SPEED", &BearingData::speeds, "speeds of b relative to a about AXIS that K and C are given for, ascending")
      .unit(dimension::angular_velocity)
      .values(1, 1000);
  return element_type(card, build);
}

}  // namespace engrane::elements::bearings
