// SPDX-License-Identifier: BSD-3-Clause
#include "elements/stop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "elements/axis_angle.hpp"
#include "elements/line.hpp"
#include "elements/stop_law.hpp"

namespace engrane {

namespace {

template <class T>
using Nodes = std::array<typename Motion<T, 2>::Node, 2>;

/// The coordinates that a stop limits. Each has `at()`, the coordinate with its rate, and `resist()`, which adds the
/// generalised force `load` with which the element resists its growth.

/// Distance of two nodes.
struct DistanceCoordinate {
  LineEnds ends;
  static constexpr NodeNeed need = NodeNeed::translation;
  static constexpr int history = 0;
  static constexpr const char* name = "LENGTH";
  static constexpr const char* help = "distance of the ends";
  static constexpr Dimension measure = dimension::length, rate_measure = dimension::velocity, load_measure = dimension::force;

  const std::array<int, 2>& nodes() const { return ends.nodes; }
  template <class T>
  struct At {
    T value, rate;
    Vec3T<T> direction;
  };
  template <class T>
  At<T> at(const Nodes<T>& node, std::span<const double>) const {
    const auto reach = ends.reach<T>(node);
    return {reach.length, reach.rate, reach.direction};
  }
  template <class T>
  void resist(const At<T>& at, const Nodes<T>&, const T& load, Balance<T, 2>& balance) const {
    ends.pull(Vec3T<T>(at.direction * load), balance);
  }
  std::string drawing() const {
    return fmt::format(R"("shape": "line", "points": {})", json(std::vector(ends.nodes.begin(), ends.nodes.end())));
  }
};

/// Turn of B from A about an axis, whole turns counted.
struct AngleCoordinate {
  std::array<int, 2> ends;
  AxisTriad triad;
  Vec3 center;
  static constexpr NodeNeed need = NodeNeed::rotation;
  static constexpr int history = turn_count::history;
  static constexpr const char* name = "ANGLE";
  static constexpr const char* help = "turn of B from A about the axis, whole turns counted";
  static constexpr Dimension measure = dimension::angle, rate_measure = dimension::angular_velocity,
                             load_measure = dimension::moment;

  const std::array<int, 2>& nodes() const { return ends; }
  template <class T>
  struct At {
    T value, rate;
    Vec3T<T> gradient;
  };
  template <class T>
  At<T> at(const Nodes<T>& node, std::span<const double> committed) const {
    const AxisAngle<T> turn = axis_angle(triad, node[0].R, node[1].R);
    const Vec3T<T> spin = rotate(node[1].R, node[1].W) - rotate(node[0].R, node[0].W);
    return {turn_count::total(turn.angle, committed), dot(turn.gradient, spin), turn.gradient};
  }
  template <class T>
  void resist(const At<T>& at, const Nodes<T>& node, const T& load, Balance<T, 2>& balance) const {
    const Vec3T<T> moment = at.gradient * load;
    balance.moment(0, rotate_back(node[0].R, Vec3T<T>(-moment)));
    balance.moment(1, rotate_back(node[1].R, moment));
  }
  std::string drawing() const {
    return fmt::format(R"("shape": "axis", "node": {}, "center": {}, "axis": {})", ends[0] != 0 ? ends[0] : ends[1], json(center),
                       json(triad.e1));
  }
};

/// Height of a point of B above a plane that A holds.
struct HeightCoordinate {
  std::array<int, 2> ends;
  Vec3 normal, plane, point;  ///< reference: the normal; from A to a point of the plane; from B to its point
  Vec3 mark;                  ///< where it is drawn: B's point, or the plane's when B is the ground
  static constexpr NodeNeed need = NodeNeed::both;
  static constexpr int history = 0;
  static constexpr const char* name = "HEIGHT";
  static constexpr const char* help = "of B's point above the plane";
  static constexpr Dimension measure = dimension::length, rate_measure = dimension::velocity, load_measure = dimension::force;

  const std::array<int, 2>& nodes() const { return ends; }
  template <class T>
  struct At {
    T value, rate;
    Vec3T<T> normal, reach, arm;  ///< from A to B's point, and from B to it, global
  };
  template <class T>
  At<T> at(const Nodes<T>& node, std::span<const double>) const {
    const auto& [a, b] = node;
    At<T> out;
    out.normal = rotate(a.R, normal);
    out.arm = rotate(b.R, point);
    out.reach = b.x + out.arm - a.x;
    out.value = dot(out.normal, Vec3T<T>(out.reach - rotate(a.R, plane)));
    const Vec3T<T> speed = b.v + cross(rotate(b.R, b.W), out.arm) - a.v - cross(rotate(a.R, a.W), out.reach);
    out.rate = dot(out.normal, speed);
    return out;
  }
  template <class T>
  void resist(const At<T>& at, const Nodes<T>& node, const T& load, Balance<T, 2>& balance) const {
    const Vec3T<T> force = at.normal * load;
    balance.force(0, Vec3T<T>(-force));
    balance.force(1, force);
    // the plane turns with A: its force acts at B's point
    balance.moment(0, rotate_back(node[0].R, Vec3T<T>(-cross(at.reach, force))));
    balance.moment(1, rotate_back(node[1].R, cross(at.arm, force)));
  }
  std::string drawing() const {
    return fmt::format(R"("shape": "arrow", "node": {}, "center": {}, "axis": {})", ends[1] != 0 ? ends[1] : ends[0], json(mark),
                       json(normal));
  }
};

/// One end of the coordinate's range. `sign` 1: the lower, which pushes the coordinate up.
struct Limit {
  double place = 0, sign = 1;
  template <class T>
  T pressed(const T& coordinate) const {
    return sign * (place - coordinate);
  }
};

template <class Coordinate>
class Stop final : public TemplatedElement<Stop<Coordinate>, 2, 12> {
 public:
  Stop(int id, const Coordinate& coordinate, std::vector<Limit> limits, const StopLaw& law, bool tells_damping)
      : TemplatedElement<Stop<Coordinate>, 2, 12>(id),
        coordinate_(coordinate),
        limits_(std::move(limits)),
        law_(law),
        tells_damping_(tells_damping) {
    Layout layout;
    layout.nodes.assign(coordinate.nodes().begin(), coordinate.nodes().end());
    layout.needs = {Coordinate::need, Coordinate::need};
    if constexpr (std::is_same_v<Coordinate, HeightCoordinate>)
      if (coordinate.point.isZero(0)) layout.needs[1] = NodeNeed::translation;
    layout.history = Coordinate::history;
    for (const Limit& limit : limits_) {
      const std::string stop = limit.sign > 0 ? "lower stop" : "upper stop";
      layout.switches.push_back({stop + " touches", stop + " parts"});
      if (law.damped()) layout.switches.push_back({stop + " presses again", stop + " presses no more"});
    }
    this->set_layout(std::move(layout));
    channels_ = {{Coordinate::name, Coordinate::measure, Coordinate::help},
                 {"SPEED", Coordinate::rate_measure, "its rate"},
                 {"GAP", Coordinate::measure, "to the nearer limit; negative: pressed together"},
                 {Coordinate::load_measure == dimension::moment ? "TORQUE" : "FORCE", Coordinate::load_measure,
                  "of the contact; positive pushes the coordinate up"},
                 {"SPRING_ENERGY", dimension::energy, "energy stored"},
                 {"DAMPER_POWER", dimension::power, "power lost"}};
  }

  template <class T>
  void evaluate(const Motion<T, 2>& motion, const State& state, Balance<T, 2>& balance) const {
    const auto at = coordinate_.template at<T>(motion.node, state.history);
    coordinate_.template resist<T>(at, motion.node, T(-push(at.value, at.rate, balance.bridge())), balance);
  }

  void commit(const State& state, std::span<double>, std::span<double> history) const override {
    if constexpr (std::is_same_v<Coordinate, AngleCoordinate>)
      turn_count::commit(axis_angle(coordinate_.triad, state.nodes[0].R, state.nodes[1].R).angle, state.history, history);
  }

  void switches(const State& state, std::span<Switch> values) const override {
    const auto at = coordinate_.template at<double>(this->template motion<double>(state).node, state.history);
    const double second = this->second(state);
    std::size_t next = 0;
    for (const Limit& limit : limits_) {
      const double pressed = limit.pressed(at.value), rate = -limit.sign * at.rate, growth = -limit.sign * second;
      values[next++] = {pressed, rate, std::abs(limit.place) + std::abs(at.value) + std::numeric_limits<double>::min()};
      if (!law_.damped()) continue;
      values[next++] = pressed > 0 ? Switch{law_.pressure(pressed, rate), law_.pressure_rate(pressed, rate, growth),
                                            law_.pressure_size(pressed, rate)}
                                   : Switch{};
    }
  }

  Energies energies(const State& state) const override {
    const auto at = coordinate_.template at<double>(this->template motion<double>(state).node, state.history);
    Energies e;
    for (const Limit& limit : limits_) {
      const double pressed = limit.pressed(at.value), rate = -limit.sign * at.rate;
      if (!(pressed > 0)) continue;
      e.potential += law_.stored(pressed);
      e.dissipated += (law_.force(pressed, rate, 0) - law_.elastic(pressed)) * rate;
    }
    return e;
  }

  const std::vector<Named>& channels() const override { return channels_; }

  void observe(const State& state, std::span<double> values) const override {
    const auto at = coordinate_.template at<double>(this->template motion<double>(state).node, state.history);
    const Energies e = energies(state);
    values[0] = at.value;
    values[1] = at.rate;
    values[2] = std::numeric_limits<double>::infinity();
    for (const Limit& limit : limits_) values[2] = std::min(values[2], -limit.pressed(at.value));
    values[3] = push(at.value, at.rate, 0);
    values[4] = e.potential;
    values[5] = e.dissipated;
  }

  std::vector<Derived> derived() const override {
    std::vector<Derived> list;
    for (const Limit& limit : limits_)
      list.push_back({limit.sign > 0 ? "lower limit" : "upper limit", limit.place, Coordinate::measure});
    if (tells_damping_) {
      Dimension d = Coordinate::rate_measure;
      d.length = static_cast<signed char>(-d.length);
      d.time = static_cast<signed char>(-d.time);
      d.angle = static_cast<signed char>(-d.angle);
      list.push_back({"damping d of Hunt and Crossley", law_.hunt, d});
    }
    return list;
  }

  Drawing drawing() const override { return {coordinate_.drawing()}; }

 private:
  /// Generalised force of the contact on the coordinate.
  template <class T>
  T push(const T& value, const T& rate, double bridge) const {
    T sum(0);
    for (const Limit& limit : limits_) sum += limit.sign * law_.force(T(limit.pressed(value)), T(-limit.sign * rate), bridge);
    return sum;
  }

  /// Second time derivative of the coordinate along the motion.
  double second(const State& state) const {
    Nodes<Taylor> node;
    for (std::size_t i = 0; i < 2; ++i) {
      const NodeState& s = state.nodes[i];
      const Mat3 W = skew(s.W), first = s.R * W, twice = s.R * (skew(s.A) + W * W);
      for (int a = 0; a < 3; ++a) {
        node[i].x[a] = {s.x[a], s.v[a], s.a[a]};
        for (int b = 0; b < 3; ++b) node[i].R(a, b) = {s.R(a, b), first(a, b), twice(a, b)};
      }
    }
    return coordinate_.template at<Taylor>(node, state.history).value.d2;
  }

  Coordinate coordinate_;
  std::vector<Limit> limits_;
  StopLaw law_;
  bool tells_damping_;
  std::vector<Named> channels_;
};

/// False, with an error, when a keyword is given that has no meaning for this kind of stop.
bool lacks(const BuildContext& context, const char* keyword, bool given, const std::string& kind, const std::string& cure) {
  if (!given) return true;
  context.error(keyword, fmt::format("{} has no meaning for a stop on {}", keyword, kind), cure);
  return false;
}

std::unique_ptr<Element> build(const StopData& data, BuildContext& context) {
  StopLaw law{data.stiffness, data.exponent};
  if (!check_nodes(context, {data.nodes[0], data.nodes[1]}) || !set_stop_damping(data.damping, context, law)) return nullptr;
  if (data.axis && data.normal) {
    context.error("NORMAL", "AXIS and NORMAL both say what is limited", "AXIS for an angle, NORMAL for the height above a plane");
    return nullptr;
  }
  const double unit = data.axis ? degree : 1;
  std::vector<Limit> limits;
  if (data.lower) limits.push_back({unit * *data.lower, 1});
  if (data.upper) limits.push_back({unit * *data.upper, -1});
  if (limits.empty() && data.normal) limits.push_back({0, 1});
  if (limits.empty()) {
    context.error("N", "a stop without limits", "MIN s, MAX s or both");
    return nullptr;
  }
  if (data.lower && data.upper && *data.lower > *data.upper) {
    context.error("MAX", fmt::format("MAX {} is below MIN {}", number(*data.upper), number(*data.lower)));
    return nullptr;
  }
  const int id = context.record.id;
  const bool tells = data.damping.is("REST");
  if (data.axis) {
    const auto axis = unit_vector(context, "AXIS", *data.axis);
    if (!axis || !lacks(context, "AT", data.at.has_value(), "an angle", "leave it out") ||
        !lacks(context, "ON", data.on.has_value(), "an angle", "leave it out"))
      return nullptr;
    const Vec3 center = context.nodes.at(data.nodes[0] != 0 ? data.nodes[0] : data.nodes[1]);
    return std::make_unique<Stop<AngleCoordinate>>(id, AngleCoordinate{data.nodes, AxisTriad(*axis), center}, limits, law, tells);
  }
  if (data.normal) {
    const auto normal = unit_vector(context, "NORMAL", *data.normal);
    if (!normal) return nullptr;
    const Vec3 &at_a = context.nodes.at(data.nodes[0]), &at_b = context.nodes.at(data.nodes[1]);
    const Vec3 plane = data.on ? Vec3(to_vector(*data.on) - at_a) : Vec3(Vec3::Zero());
    const Vec3 point = data.at ? Vec3(to_vector(*data.at) - at_b) : Vec3(Vec3::Zero());
    const Vec3 mark = data.nodes[1] != 0 ? Vec3(at_b + point) : Vec3(at_a + plane);
    return std::make_unique<Stop<HeightCoordinate>>(id, HeightCoordinate{data.nodes, *normal, plane, point, mark}, limits, law,
                                                    tells);
  }
  if (!lacks(context, "ON", data.on.has_value(), "a distance", "NORMAL x y z is the plane that ON is a point of")) return nullptr;
  const auto ends = LineEnds::of(context, data.nodes, data.at, "NORMAL x y z is for a point above a plane");
  if (!ends) return nullptr;
  return std::make_unique<Stop<DistanceCoordinate>>(id, DistanceCoordinate{*ends}, limits, law, tells);
}

}  // namespace

bool set_stop_damping(const deck::Tagged& damping, const BuildContext& context, StopLaw& law) {
  if (!damping.given()) return true;
  const std::vector<double>& v = damping.values;
  if (std::any_of(v.begin(), v.end(), [](double x) { return x < 0; })) {
    context.error("DAMP", "damping must not be negative");
    return false;
  }
  if (damping.is("REST")) {
    if (!(v[0] > 0 && v[0] <= 1) || !(v[1] > 0)) {
      context.error("DAMP",
                    fmt::format("REST {} {}: no coefficient of restitution at a speed of impact", number(v[0]), number(v[1])),
                    "REST e v with 0 < e <= 1 and v > 0: what arrives with v leaves with e v");
      return false;
    }
    law.hunt = StopLaw::hunt_of_restitution(v[0], v[1]);
  } else if (damping.is("HUNT")) {
    law.hunt = v[0];
  } else {
    law.linear = v[0];
  }
  return true;
}

void add_stop_damping(deck::FieldBuilder field) {
  field.synonyms({"AMOR"})
      .option({"HUNT", {}, "Hunt and Crossley: the force is multiplied by 1 + d times the rate of penetration", 1, 1})
      .option({"REST", {"RESTITUTION"}, "Hunt and Crossley with the d for which what arrives with v leaves with e v: e v", 2, 2})
      .option({"LINEAR", {"LINEAIRE"}, "a damper beside the spring: c", 1, 1});
}

ElementType stop_type() {
  deck::Card<StopData> card("STOP", {"BUTEE"}, "Stop: one-sided contact on a distance, an angle or a height above a plane");
  card.numbered()
      .chapter("Stiffeners, dampers, transfer functions")
      .describe(
          "Keeps the distance of two nodes, with AXIS the turn of node b from node a about an axis that a holds, or with NORMAL "
          "the height of a point of b above a plane that a holds, above MIN and below MAX. Beyond a limit by d it pushes "
          "back with K d**EXP and damping; it never pulls. In dynamics steps end where it touches and parts.")
      .example("I 9 STOP N 0 2  NORMAL 0 0 1  MIN 0.05  K 1D8 EXP 1.5  DAMP REST 0.8 2.0")
      .example("I 10 STOP N 3 4  AXIS 0 0 1  MIN -30 MAX 45  K 2D3  DAMP LINEAR 1.5")
      .example("I 11 STOP N 4 5  MAX 0.25  K 1D6");
  card.add("N", &StopData::nodes, "the two nodes, a and b; 0 is the ground")
      .synonyms({"NODES", "NOEUDS"})
      .refers(deck::Reference::node)
      .required();
  card.add("AXIS", &StopData::axis, "limits the turn about this axis").synonyms({"AXE"});
  card.add("NORMAL", &StopData::normal, "limits the height above a plane: its normal, towards b").synonyms({"NORMALE"});
  card.add("ON", &StopData::on, "a point of the plane, in the reference configuration; default: node a").unit(dimension::length);
  card.add("AT", &StopData::at,
           "the point of b above the plane (default: node b), or the ground's end of a distance (the origin)")
      .unit(dimension::length);
  card.add("MIN", &StopData::lower, "lower limit: a length, or degrees with AXIS; above a plane 0 when neither is given");
  card.add("MAX", &StopData::upper, "upper limit: a length, or degrees with AXIS");
  card.add("K", &StopData::stiffness, "stiffness: force or moment at a penetration of one (one radian)")
      .synonyms({"RAIDEUR"})
      .positive()
      .required();
  card.add("EXP", &StopData::exponent, "exponent of the penetration: 1 a spring, 1.5 Hertz's point contact")
      .synonyms({"EXPOSANT"})
      .at_least(1);
  add_stop_damping(card.add("DAMP", &StopData::damping, "damping; none when not given"));
  return element_type(card, build);
}

}  // namespace engrane
