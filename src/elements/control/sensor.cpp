// SPDX-License-Identifier: BSD-3-Clause
#include "elements/control/sensor.hpp"

#include <fmt/format.h>

#include "elements/common/building.hpp"
#include "elements/control/joint_coordinate.hpp"

namespace engrane::elements::control {

namespace {

class Sensor final : public TemplatedElement<Sensor, 2, 1>, public joints::CoordinateOwner {
 public:
  Sensor(int id, const Coordinate& coordinate) : TemplatedElement(id), coordinate_(coordinate) {
    Layout layout;
    layout.nodes.assign(coordinate.nodes.begin(), coordinate.nodes.end());
    // the sensor reads the nodes but needs none of their unknowns: it must not give a node rotations
    layout.needs = {NodeNeed{}, NodeNeed{}};
    layout.history = coordinate.history();
    set_layout(std::move(layout));
    const bool angle = coordinate.is_angle();
    channels_ = {{coordinate.name, coordinate.dimension(), angle ? "turn of b from a, whole turns counted" : "of b from a"},
                 {"SPEED", coordinate.rate_dimension(), "rate of " + coordinate.name},
                 {"RELATIVE_SPEED", coordinate.rate_dimension(),
                  angle ? "size of the relative angular velocity" : "size of the relative velocity", Channel::Course::size}};
  }

  template <class T>
  void evaluate(const Motion<T, 2>&, const State&, Balance<T, 2>&) const {}

  void count_turns(const State& state, std::span<double>, std::span<double> history) const override {
    coordinate_.commit(state.nodes[0], state.nodes[1], state.history, history);
  }

  const std::vector<Channel>& channels() const override { return channels_; }
  std::vector<Coordinate> coordinates() const override { return {coordinate_}; }

  void observe(const State& state, std::span<double> values) const override {
    const NodeState &a = state.nodes[0], &b = state.nodes[1];
    const auto reading = coordinate_.read<double>(a, b, state.history);
    values[0] = reading.measured.value;
    values[1] = reading.rate;
    values[2] = coordinate_.is_angle() ? (b.R * b.W - a.R * a.W).norm() : (b.v - a.v).norm();
  }

  Drawing drawing() const override {
    const auto [a, b] = coordinate_.nodes;
    if (a != 0 && b != 0) return {fmt::format(R"("shape": "line", "points": {})", json(layout().nodes))};
    return {};
  }

 private:
  Coordinate coordinate_;
  std::vector<Channel> channels_;
};

/// The coordinate measured by a sensor; returns nothing, with an error, if the data are invalid.
std::optional<Coordinate> measured_coordinate(const SensorData& data, const BuildContext& context) {
  if (!check_nodes(context, data.nodes)) return {};
  Coordinate c;
  c.nodes = {data.nodes.size() == 2 ? data.nodes[0] : 0, data.nodes.back()};
  const Vec3 &at_a = context.nodes.at(c.nodes[0]), &at_b = context.nodes.at(c.nodes[1]);
  const bool distance = data.kind.is("DISTANCE");
  if (data.at && (!distance || (c.nodes[0] != 0 && c.nodes[1] != 0))) {
    context.error("AT", distance ? "AT is where the ground's end is, and neither node is the ground" : "AT belongs to a DISTANCE",
                  distance ? "leave AT out, or make one node 0" : "leave AT out");
    return {};
  }
  if (distance) {
    if (data.axis) {
      context.error("AXIS", "a distance has no axis", "leave AXIS out; DISPLACEMENT AXIS x y z measures along a direction");
      return {};
    }
    c.name = "DISTANCE";
    c.what = joints::Measure::distance;
    c.frame.turns_a = c.nodes[0] == 0;  // makes the ground's reaction complete
    c.frame.turns_b = c.nodes[1] == 0;
    if (data.at) (c.nodes[0] == 0 ? c.frame.arm_a : c.frame.arm_b) = to_vector(*data.at);
    if (same_place(at_a + c.frame.arm_a, at_b + c.frame.arm_b)) {
      context.error("N", fmt::format("nodes {} and {} are in one place: there is no line between them", c.nodes[0], c.nodes[1]),
                    "DISPLACEMENT AXIS x y z measures from zero");
      return {};
    }
    c.point = at_b;
    return c;
  }
  if (!data.axis) {
    context.error("AXIS", fmt::format("{} needs an axis", data.kind.tag), "AXIS x y z; node a carries it");
    return {};
  }
  const auto axis = unit_vector(context, "AXIS", *data.axis);
  if (!axis) return {};
  const AxisTriad triad(*axis);
  c.frame.set_axes(triad.e1, triad.e2);
  c.point = at_b;
  if (data.kind.is("ANGLE")) {
    c.name = "ANGLE";
    c.what = joints::Measure::angle;
    return c;
  }
  c.name = "DISPLACEMENT";
  c.what = joints::Measure::gap_1;
  c.frame.arm_a = at_b - at_a;  // the point of a's body that coincides with b in the reference configuration
  c.frame.turns_b = c.nodes[1] == 0;
  return c;
}

std::unique_ptr<Element> build(const SensorData& data, BuildContext& context) {
  const auto coordinate = measured_coordinate(data, context);
  if (!coordinate) return nullptr;
  return std::make_unique<Sensor>(context.record.id, *coordinate);
}

}  // namespace

ElementType sensor_type() {
  deck::Card<SensorData> card("SENSOR", {"CAPTEUR"}, "Observes a distance, an angle or a displacement between two nodes");
  card.numbered()
      .chapter("Control and computation elements")
      .describe(
          "It has no forces and adds no unknowns. A CONTROLLER may measure it, and act along what it measures. With one node the "
          "other is the ground. AXIS is carried by a. Angles count turns.")
      .example("I 20 SENSOR N 1 2  DISTANCE")
      .example("I 21 SENSOR N 3  ANGLE  AXIS 0 0 1")
      .example("I 22 SENSOR N 0 3  DISPLACEMENT  AXIS 1 0 0");
  card.add("N", &SensorData::nodes, "one node, or the two nodes a and b; 0 is the ground")
      .synonyms({"NODES", "NOEUDS"})
      .values(1, 2)
      .refers(deck::Reference::node)
      .required();
  card.add("KIND", &SensorData::kind, "what is measured")
      .synonyms({"GENRE"})
      .positional()
      .required()
      .option({"DISTANCE", {}, "the distance of the nodes"})
      .option({"ANGLE", {}, "the turn of b from a about AXIS, in radians"})
      .option({"DISPLACEMENT", {"DEPLACEMENT"}, "the displacement of b from a's body along AXIS"});
  card.add("AXIS", &SensorData::axis, "direction, in the reference configuration").synonyms({"AXE"});
  card.add("AT", &SensorData::at, "the ground's end of a DISTANCE; default: the origin").unit(dimension::length);
  return element_type(card, build);
}

}  // namespace engrane::elements::control
