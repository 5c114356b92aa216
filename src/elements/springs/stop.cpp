// SPDX-License-Identifier: BSD-3-Clause
#include "elements/springs/stop.hpp"

#include <fmt/format.h>

#include "elements/common/axis_angle.hpp"
#include "elements/common/line.hpp"
#include "model/determined_channels.hpp"

namespace engrane::elements::springs {

namespace {

template <class T>
using Nodes = std::array<typename Motion<T, 2>::Node, 2>;

// Coordinates that a stop can limit. `at()` returns the coordinate with its rate. `resist()` adds the generalised force `load`
// with which the element resists an increase of the coordinate.

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

/// Rotation of B relative to A about an axis, counting whole turns.
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

/// Height of a point of B above a plane fixed to A.
struct HeightCoordinate {
  std::array<int, 2> ends;
  Vec3 normal, plane, point;  ///< reference configuration: the normal; from A to a point of the plane; from B to its point
  Vec3 mark;                  ///< where it is drawn: B's point, or that of the plane if B is the ground
  static constexpr NodeNeed need = NodeNeed::both;
  static constexpr int history = 0;
  static constexpr const char* name = "HEIGHT";
  static constexpr const char* help = "height of B's point above the plane";
  static constexpr Dimension measure = dimension::length, rate_measure = dimension::velocity, load_measure = dimension::force;

  const std::array<int, 2>& nodes() const { return ends; }
  template <class T>
  struct At {
    T value, rate;
    Vec3T<T> normal, reach, arm;  ///< global: the normal; from A to B's point; from B to its point
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
    // the plane rotates with A, so that the contact force acts on A at B's point
    balance.moment(0, rotate_back(node[0].R, Vec3T<T>(-cross(at.reach, force))));
    balance.moment(1, rotate_back(node[1].R, cross(at.arm, force)));
  }
  std::string drawing() const {
    return fmt::format(R"("shape": "arrow", "node": {}, "center": {}, "axis": {})", ends[1] != 0 ? ends[1] : ends[0], json(mark),
                       json(normal));
  }
};

template <class Coordinate>
class Stop final : public TemplatedElement<Stop<Coordinate>, 2, 12>, public DeterminedChannels {
 public:
  Stop(int id, const Coordinate& coordinate, StopRange range, bool tells_damping)
      : TemplatedElement<Stop<Coordinate>, 2, 12>(id),
        coordinate_(coordinate),
        range_(std::move(range)),
        tells_damping_(tells_damping) {
    Layout layout;
    layout.nodes.assign(coordinate.nodes().begin(), coordinate.nodes().end());
    layout.needs = {Coordinate::need, Coordinate::need};
    if constexpr (std::is_same_v<Coordinate, DistanceCoordinate>) layout.needs = coordinate.ends.needs();
    if constexpr (std::is_same_v<Coordinate, HeightCoordinate>)
      if (coordinate.point.isZero(0)) layout.needs[1] = NodeNeed::translation;
    layout.history = Coordinate::history;
    range_.name_switches(layout.switches, "");
    this->set_layout(std::move(layout));
    const bool turns = Coordinate::load_measure == dimension::moment;
    channels_ = {{Coordinate::name, Coordinate::measure, Coordinate::help},
                 {"SPEED", Coordinate::rate_measure, fmt::format("rate of {}", Coordinate::name)},
                 {"GAP", Coordinate::measure, "gap to the nearer limit; negative: pressed together"},
                 {turns ? "TORQUE" : "FORCE", Coordinate::load_measure,
                  fmt::format("{} of the contact; positive pushes the coordinate up", turns ? "torque" : "force")},
                 {"SPRING_ENERGY", dimension::energy, "energy stored"},
                 {"DAMPER_POWER", dimension::power, "power lost"}};
  }

  template <class T>
  void evaluate(const Motion<T, 2>& motion, const State& state, Balance<T, 2>& balance) const {
    const auto at = coordinate_.template at<T>(motion.node, state.history);
    coordinate_.template resist<T>(at, motion.node, T(-range_.push(at.value, at.rate, balance.contact_homotopy())), balance);
  }

  void count_turns(const State& state, std::span<double>, std::span<double> history) const override {
    if constexpr (std::is_same_v<Coordinate, AngleCoordinate>)
      turn_count::commit(axis_angle(coordinate_.triad, state.nodes[0].R, state.nodes[1].R).angle, state.history, history);
  }

  void switches(const State& state, std::span<Switch> values) const override {
    const auto at = coordinate_.template at<double>(this->template motion<double>(state).node, state.history);
    const auto nodes = along_motion(state);
    range_.switches(at.value, at.rate, coordinate_.template at<Taylor>(nodes, state.history).value.d2, values);
  }

  Energies energies(const State& state) const override {
    const auto at = coordinate_.template at<double>(this->template motion<double>(state).node, state.history);
    Energies e;
    e.potential = range_.stored(at.value);
    e.dissipated = range_.lost(at.value, at.rate);
    return e;
  }

  const std::vector<Channel>& channels() const override { return channels_; }

  void observe(const State& state, std::span<double> values) const override {
    const auto at = coordinate_.template at<double>(this->template motion<double>(state).node, state.history);
    const Energies e = energies(state);
    values[0] = at.value;
    values[1] = at.rate;
    values[2] = range_.gap(at.value);
    values[3] = range_.push(at.value, at.rate, 0);
    values[4] = e.potential;
    values[5] = e.dissipated;
  }

  std::vector<Determined> determined() const override {
    return range_.two_sided() ? std::vector<Determined>{{2, {0}}} : std::vector<Determined>();
  }
  double determine(int, double, std::span<const double> coordinate) const override { return range_.gap(coordinate[0]); }

  std::vector<Derived> derived() const override {
    std::vector<Derived> list;
    for (const StopLimit& limit : range_.limits)
      list.push_back({limit.sign > 0 ? "lower limit" : "upper limit", limit.place, Coordinate::measure, true});
    if (tells_damping_) {
      Dimension d = Coordinate::rate_measure;
      d.length = static_cast<signed char>(-d.length);
      d.time = static_cast<signed char>(-d.time);
      d.angle = static_cast<signed char>(-d.angle);
      list.push_back({"damping d of Hunt and Crossley", range_.law.hunt, d});
    }
    return list;
  }

  Drawing drawing() const override { return {coordinate_.drawing()}; }

 private:
  Coordinate coordinate_;
  StopRange range_;
  bool tells_damping_;
  std::vector<Channel> channels_;
};

/// Reports an error and returns false if a keyword is given that has no meaning for this kind of stop.
bool lacks(const BuildContext& context, const char* keyword, bool given, const std::string& kind, const std::string& cure) {
  if (!given) return true;
  context.error(keyword, fmt::format("{} has no meaning for a stop on {}", keyword, kind), cure);
  return false;
}

std::unique_ptr<Element> build(const StopData& data, BuildContext& context) {
  if (!check_nodes(context, {data.nodes[0], data.nodes[1]})) return nullptr;
  if (data.axis && data.normal) {
    context.error("NORMAL", "AXIS and NORMAL both say what is limited", "AXIS for an angle, NORMAL for the height above a plane");
    return nullptr;
  }
  auto range = StopRange::of(context, data, {}, data.axis ? degree : 1);
  if (!range) return nullptr;
  if (!range->given() && data.normal) range->limits.push_back({0, 1});
  if (!range->given()) {
    context.error("N", "a stop without limits", "MIN s, MAX s or both");
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
    return std::make_unique<Stop<AngleCoordinate>>(id, AngleCoordinate{data.nodes, AxisTriad(*axis), center}, *range, tells);
  }
  if (data.normal) {
    const auto normal = unit_vector(context, "NORMAL", *data.normal);
    if (!normal) return nullptr;
    const Vec3 &at_a = context.nodes.at(data.nodes[0]), &at_b = context.nodes.at(data.nodes[1]);
    const Vec3 plane = data.on ? Vec3(to_vector(*data.on) - at_a) : Vec3(Vec3::Zero());
    const Vec3 point = data.at ? Vec3(to_vector(*data.at) - at_b) : Vec3(Vec3::Zero());
    const Vec3 mark = data.nodes[1] != 0 ? Vec3(at_b + point) : Vec3(at_a + plane);
    return std::make_unique<Stop<HeightCoordinate>>(id, HeightCoordinate{data.nodes, *normal, plane, point, mark}, *range, tells);
  }
  if (!lacks(context, "ON", data.on.has_value(), "a distance", "NORMAL x y z is the plane that ON is a point of")) return nullptr;
  const auto ends = LineEnds::of(context, data.nodes, data.at, "NORMAL x y z is for a point above a plane");
  if (!ends) return nullptr;
  return std::make_unique<Stop<DistanceCoordinate>>(id, DistanceCoordinate{*ends}, *range, tells);
}

}  // namespace

ElementType stop_type() {
  deck::Card<StopData> card("STOP", {"BUTEE"}, "Stop: one-sided contact on a distance, an angle or a height above a plane");
  card.numbered()
      .chapter("Stiffeners, dampers, transfer functions")
      .describe(
          "Keeps the distance of two nodes, with AXIS the turn of node b from node a about an axis that a holds, or with NORMAL "
          "the height of a point of b above a plane that a holds, above MIN and below MAX. At a penetration d beyond "
          "a limit the force is K d**EXP, and damping; it never pulls. In dynamics steps end where it touches and parts.")
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
  add_stop_damping(card.add("DAMP", &StopData::damping, "damping; none when not given").synonyms({"AMOR"}));
  return element_type(card, build);
}

}  // namespace engrane::elements::springs
