// SPDX-License-Identifier: BSD-3-Clause
#include "elements/springs/torsion_spring.hpp"

#include <fmt/format.h>

#include "elements/common/along_motion.hpp"
#include "elements/common/axis_angle.hpp"
#include "elements/common/building.hpp"
#include "model/templated_element.hpp"

namespace engrane::elements::springs {

namespace {

class TorsionSpring final : public TemplatedElement<TorsionSpring, 2, 6> {
 public:
  TorsionSpring(int id, const std::array<int, 2>& nodes, const Vec3& axis, const Vec3& center, const SpringLaw& law,
                double angle0)
      : TemplatedElement(id), triad_(axis), center_(center), law_(law), angle0_(angle0) {
    Layout layout;
    layout.nodes.assign(nodes.begin(), nodes.end());
    layout.needs = {NodeNeed::rotation, NodeNeed::rotation};
    layout.history = turn_count::history;
    law.name_switches(layout.switches, "");
    set_layout(std::move(layout));
  }

  template <class T>
  void evaluate(const Motion<T, 2>& motion, const State& state, Balance<T, 2>& balance) const {
    const auto& a = motion.node[0];
    const auto& b = motion.node[1];
    const AxisAngle<T> turn = axis_angle(triad_, a.R, b.R);
    const T angle = turn_count::total(turn.angle, state.history);
    const Vec3T<T> spin = rotate(b.R, b.W) - rotate(a.R, a.W);
    const T torque = law_.force(T(angle - angle0_), T(dot(turn.gradient, spin)), state.time, balance.contact_homotopy());
    const Vec3T<T> moment = turn.gradient * torque;
    balance.moment(0, rotate_back(a.R, Vec3T<T>(-moment)));
    balance.moment(1, rotate_back(b.R, moment));
  }

  void count_turns(const State& state, std::span<double>, std::span<double> history) const override {
    turn_count::commit(turn(state).angle, state.history, history);
  }

  void switches(const State& state, std::span<Switch> values) const override {
    if (values.empty()) return;
    const auto nodes = along_motion(state);
    const Taylor turned = turn_count::total(axis_angle(triad_, nodes[0].R, nodes[1].R).angle, state.history);
    law_.switches(turned - angle0_, state.time, std::abs(turned.value) + std::abs(angle0_), values);
  }

  Energies energies(const State& state) const override { return law_.energies(angle(state) - angle0_, speed(state), state.time); }

  const std::vector<Channel>& channels() const override {
    static const std::vector<Channel> all = {{"ANGLE", dimension::angle, "turn of B from A about the axis, whole turns counted"},
                                             {"SPEED", dimension::angular_velocity, "rate of the angle"},
                                             {"TORQUE", dimension::moment, "torque of spring and damper on B, the opposite on A"},
                                             {"SPRING_ENERGY", dimension::energy, "energy stored"},
                                             {"DAMPER_POWER", dimension::power, "power lost in the damper"}};
    return all;
  }

  void observe(const State& state, std::span<double> values) const override {
    const Energies e = energies(state);
    values[0] = angle(state);
    values[1] = speed(state);
    values[2] = -law_.force(values[0] - angle0_, values[1], state.time, 0);
    values[3] = e.potential;
    values[4] = e.dissipated;
  }

  Drawing drawing() const override {
    const auto& nodes = layout().nodes;
    Drawing shapes = {fmt::format(R"("shape": "axis", "node": {}, "center": {}, "axis": {})", nodes[0] != 0 ? nodes[0] : nodes[1],
                                  json(center_), json(triad_.e1))};
    if (nodes[0] != 0 && nodes[1] != 0) shapes.push_back(fmt::format(R"("shape": "coil", "points": {})", json(nodes)));
    return shapes;
  }

 private:
  AxisAngle<double> turn(const State& state) const { return axis_angle(triad_, state.nodes[0].R, state.nodes[1].R); }
  double angle(const State& state) const { return turn_count::total(turn(state).angle, state.history); }
  double speed(const State& state) const {
    const NodeState &a = state.nodes[0], &b = state.nodes[1];
    return turn(state).gradient.dot(b.R * b.W - a.R * a.W);
  }

  AxisTriad triad_;
  Vec3 center_;
  SpringLaw law_;
  double angle0_;
};

std::unique_ptr<Element> build(const TorsionSpringData& data, BuildContext& context) {
  const auto axis = unit_vector(context, "AXIS", data.axis);
  if (!check_nodes(context, {data.nodes[0], data.nodes[1]}) || !axis) return nullptr;
  const auto law = SpringLaw::of(context, data, data.stiffness, data.damping, -data.angle0 * degree, 0.1);
  if (!law) return nullptr;
  if (!law->acts()) {
    context.error("K", "a torsion spring with neither stiffness nor damping does nothing", "K k and C c, per radian");
    return nullptr;
  }
  const Vec3 center = context.nodes.at(data.nodes[0] != 0 ? data.nodes[0] : data.nodes[1]);
  return std::make_unique<TorsionSpring>(context.record.id, data.nodes, *axis, center, *law, data.angle0 * degree);
}

}  // namespace

ElementType torsion_spring_type() {
  deck::Card<TorsionSpringData> card("TSPRING", {"RESSORT_TORSION"}, "Torsion spring and damper between two nodes");
  card.numbered()
      .chapter("Stiffeners, dampers, transfer functions")
      .describe(
          "Acts on the turn of node b relative to node a about an axis that node a holds; the angle is counted in turns. "
          "It holds the nodes together in no other way: a HINGE or GEAR does.")
      .example("I 5 TSPRING N 1 2  AXIS 0 0 1  K 1.7D4  C 0.076")
      .example("I 5 TSPRING N 1 2  AXIS 0 0 1  LAW TABLE 3  ANGLE0 15");
  card.add("N", &TorsionSpringData::nodes, "the two nodes, a and b; 0 is the ground")
      .synonyms({"NODES", "NOEUDS"})
      .refers(deck::Reference::node)
      .required();
  card.add("AXIS", &TorsionSpringData::axis, "direction of the axis, in the reference configuration")
      .synonyms({"AXE"})
      .required();
  card.add("K", &TorsionSpringData::stiffness, "moment per radian").unit(dimension::torsional_stiffness).at_least(0);
  card.add("C", &TorsionSpringData::damping, "moment per radian and time").unit(dimension::torsional_damping).at_least(0);
  add_spring_law(card, "angle in radians", "moment");
  card.add("ANGLE0", &TorsionSpringData::angle0, "angle at which the spring is relaxed").unit(dimension::angle);
  return element_type(card, build);
}

}  // namespace engrane::elements::springs
