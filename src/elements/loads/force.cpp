// SPDX-License-Identifier: BSD-3-Clause
#include "elements/loads/force.hpp"

#include <fmt/format.h>

#include "elements/common/line.hpp"
#include "elements/loads/applied_load.hpp"

namespace engrane::elements::loads {

namespace {

/// Force along the line of two ends; positive pushes them apart.
class LineForce final : public AppliedLoad<LineForce, 2, 6> {
 public:
  LineForce(int id, const LineEnds& ends, double value, const Function* function)
      : AppliedLoad(id, value, function), ends_(ends) {
    Layout layout;
    layout.nodes.assign(ends.nodes.begin(), ends.nodes.end());
    layout.needs = ends.needs();
    set_layout(std::move(layout));
  }

  template <class T>
  void evaluate(const Motion<T, 2>& motion, const State&, Balance<T, 2>& balance) const {
    const auto reach = ends_.reach<T>(motion.node);
    ends_.pull(Vec3T<T>(reach.direction * (-size_at(motion.time))), balance);
  }

  const std::vector<Channel>& channels() const override {
    static const std::vector<Channel> all = {{"FORCE", dimension::force, "positive pushes the nodes apart"},
                                             {"LENGTH", dimension::length, "distance of the ends"},
                                             {"SPEED", dimension::velocity, "rate of the length"},
                                             {"POWER", dimension::power, "power given to the mechanism"}};
    return all;
  }

  void observe(const State& state, std::span<double> values) const override {
    AppliedLoad::observe(state, values);
    values[1] = ends_.reach<double>(state.nodes).length;
  }

  double speed(const State& state) const { return ends_.reach<double>(state.nodes).rate; }

  Drawing drawing() const override { return {fmt::format(R"("shape": "line", "points": {})", json(layout().nodes))}; }

 private:
  LineEnds ends_;
};

/// External force on one node, at a point that moves with it.
class NodeForce final : public AppliedLoad<NodeForce, 1, 6> {
 public:
  NodeForce(int id, int node, const Vec3& direction, const Vec3& center, const Vec3& offset, bool follow, double value,
            const Function* function)
      : AppliedLoad(id, value, function), direction_(direction), point_(center + offset), offset_(offset), follow_(follow) {
    Layout layout;
    layout.nodes = {node};
    layout.needs = {follow || !offset.isZero(0) ? NodeNeed::both : NodeNeed::translation};
    set_layout(std::move(layout));
  }

  template <class T>
  void evaluate(const Motion<T, 1>& motion, const State&, Balance<T, 1>& balance) const {
    const auto& node = motion.node[0];
    const T size = size_at(motion.time);
    const Vec3T<T> along = direction_.template cast<T>();
    const Vec3T<T> force = (follow_ ? rotate(node.R, direction_) : along) * size;
    balance.force(0, Vec3T<T>(-force));
    if (!offset_.isZero(0)) {
      const Vec3T<T> own = follow_ ? Vec3T<T>(along * size) : rotate_back(node.R, force);
      balance.moment(0, Vec3T<T>(-cross(Vec3T<T>(offset_.template cast<T>()), own)));
    }
  }

  const std::vector<Channel>& channels() const override {
    static const std::vector<Channel> all = {{"FORCE", dimension::force, "along its direction"},
                                             {"SPEED", dimension::velocity, "of the point along the direction"},
                                             {"POWER", dimension::power, "power given to the mechanism"}};
    return all;
  }

  Drawing drawing() const override {
    return {fmt::format(R"("shape": "arrow", "node": {}, "center": {}, "axis": {}, "holder": {})", layout().nodes[0],
                        json(point_), json(Vec3(value() < 0 ? -direction_ : direction_)), follow_ ? layout().nodes[0] : 0)};
  }

  double speed(const State& state) const {
    const NodeState& node = state.nodes[0];
    const Vec3 along = follow_ ? Vec3(node.R * direction_) : direction_;
    return along.dot(node.v + node.R * cross(node.W, offset_));
  }

 private:
  Vec3 direction_, point_, offset_;
  bool follow_;
};

std::unique_ptr<Element> build_line(const ForceData& data, BuildContext& context, const Function* function) {
  if (data.direction) {
    context.error("DIR", "two nodes and a direction", "between two nodes the force is along their line; DIR is for one node");
    return nullptr;
  }
  if (data.follow || data.fixed) {
    context.error(data.follow ? "FOLLOW" : "FIXED", "between two nodes the force is along their line",
                  "FOLLOW and FIXED are for one node with DIR");
    return nullptr;
  }
  const auto ends = LineEnds::of(context, {data.nodes[0], data.nodes[1]}, data.at, "give DIR x y z and one node");
  if (!ends) return nullptr;
  return std::make_unique<LineForce>(context.record.id, *ends, data.value, function);
}

std::unique_ptr<Element> build(const ForceData& data, BuildContext& context) {
  const Function* function = nullptr;
  const bool found = find_function(context, data.function, function);
  if (!check_nodes(context, data.nodes) || !found) return nullptr;
  if (data.nodes.size() == 2) return build_line(data, context, function);

  if (!data.direction) {
    context.error("N", "a force on one node needs a direction", "DIR x y z, or a second node to push against");
    return nullptr;
  }
  const auto direction = unit_vector(context, "DIR", *data.direction);
  if (data.follow && data.fixed) {
    context.error("FIXED", "the direction cannot both follow the node and be fixed in space", "give FOLLOW or FIXED");
    return nullptr;
  }
  if (!direction) return nullptr;
  const int node = data.nodes[0];
  const Vec3 center = context.nodes.at(node);
  const Vec3 offset = data.at ? Vec3(to_vector(*data.at) - center) : Vec3(Vec3::Zero());
  return std::make_unique<NodeForce>(context.record.id, node, *direction, center, offset, data.follow, data.value, function);
}

}  // namespace

ElementType force_type() {
  deck::Card<ForceData> card("FORCE", {"EFFORT"}, "Force between two nodes along their line, or on one node from outside");
  card.numbered()
      .chapter("Special boundary conditions and multi-point constraints")
      .describe(
          "Between two nodes a positive V pushes them apart, as an actuator does; an end on the ground (node 0) is at the "
          "origin unless AT says otherwise. On one node V acts along DIR, which stays fixed in space (FIXED, the default) "
          "or turns with the node (FOLLOW), at the node or at the point AT that moves with it.")
      .example("I 6 FORCE N 4 5  V 2500  NF 3")
      .example("I 7 FORCE N 4  DIR 0 -1 0  V 100  FOLLOW  AT 0.5 0 0");
  card.add("N", &ForceData::nodes, "one node, or the two nodes a and b; 0 is the ground")
      .synonyms({"NODES", "NOEUDS"})
      .values(1, 2)
      .refers(deck::Reference::node)
      .required();
  card.add("DIR", &ForceData::direction, "direction of the force on one node, in the reference configuration");
  card.add("V", &ForceData::value, "force").synonyms({"VAL"}).unit(dimension::force).required();
  card.add("NF", &ForceData::function, "function of time that multiplies V").refers(deck::Reference::function).at_least(0);
  card.add("FOLLOW", &ForceData::follow, "the direction turns with the node").synonyms({"SUIVEUR"});
  card.add("FIXED", &ForceData::fixed, "the direction is fixed in space").synonyms({"FIXE"});
  card.add("AT", &ForceData::at, "point where it acts, or the ground's end, in the reference configuration")
      .unit(dimension::length);
  return element_type(card, build);
}

}  // namespace engrane::elements::loads
