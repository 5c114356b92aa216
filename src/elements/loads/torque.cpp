// SPDX-License-Identifier: BSD-3-Clause
#include "elements/loads/torque.hpp"

#include <fmt/format.h>

#include "elements/common/building.hpp"
#include "elements/loads/applied_load.hpp"

namespace engrane::elements::loads {

namespace {

/// Moment between two nodes; the ground replaces a missing first one.
class Torque final : public AppliedLoad<Torque, 2, 6> {
 public:
  enum class Holder : unsigned char { space, first, last };  ///< what the axis is fixed to

  Torque(int id, int first, int last, const Vec3& axis, double value, const Function* function, Holder holder, const Vec3& center)
      : AppliedLoad(id, value, function), axis_(axis), holder_(holder), center_(center) {
    Layout layout;
    layout.nodes = {first, last};
    layout.needs = {NodeNeed::rotation, NodeNeed::rotation};
    set_layout(std::move(layout));
  }

  template <class T>
  void evaluate(const Motion<T, 2>& motion, const State&, Balance<T, 2>& balance) const {
    const auto& a = motion.node[0];
    const auto& b = motion.node[1];
    const Vec3T<T> held = axis_.template cast<T>();
    const Vec3T<T> axis = holder_ == Holder::space ? held : holder_ == Holder::first ? rotate(a.R, axis_) : rotate(b.R, axis_);
    const Vec3T<T> moment = axis * size_at(motion.time);
    balance.moment(0, rotate_back(a.R, moment));
    balance.moment(1, rotate_back(b.R, Vec3T<T>(-moment)));
  }

  const std::vector<Channel>& channels() const override {
    static const std::vector<Channel> all = {{"TORQUE", dimension::moment, "moment on the last node about the axis"},
                                             {"SPEED", dimension::angular_velocity, "relative speed about the axis"},
                                             {"POWER", dimension::power, "power given to the mechanism"}};
    return all;
  }

  Drawing drawing() const override {
    const auto& nodes = layout().nodes;
    const bool on_last = nodes[1] != 0;  // the first node bears the opposite moment
    return {fmt::format(R"("shape": "arrow", "couple": true, "node": {}, "center": {}, "axis": {}, "holder": {})",
                        on_last ? nodes[1] : nodes[0], json(center_), json(Vec3((value() < 0) == on_last ? -axis_ : axis_)),
                        holder_ == Holder::space   ? 0
                        : holder_ == Holder::first ? nodes[0]
                                                   : nodes[1])};
  }

  double speed(const State& state) const {
    const NodeState &a = state.nodes[0], &b = state.nodes[1];
    const Vec3 axis = holder_ == Holder::space ? axis_ : Vec3((holder_ == Holder::first ? a.R : b.R) * axis_);
    return axis.dot(b.R * b.W - a.R * a.W);
  }

 private:
  Vec3 axis_;
  Holder holder_;
  Vec3 center_;
};

std::unique_ptr<Element> build(const TorqueData& data, BuildContext& context) {
  const auto axis = unit_vector(context, "AXIS", data.axis);
  const Function* function = nullptr;
  const bool found = find_function(context, data.function, function);
  if (data.follow && data.fixed) {
    context.error("FIXED", "the axis cannot both follow a node and be fixed in space", "give FOLLOW or FIXED");
    return nullptr;
  }
  if (!check_nodes(context, data.nodes) || !axis || !found) return nullptr;
  const bool pair = data.nodes.size() == 2;
  const int first = pair ? data.nodes[0] : 0, last = data.nodes.back();
  const bool follows = data.follow || (pair && !data.fixed);
  const auto holder = !follows ? Torque::Holder::space : pair ? Torque::Holder::first : Torque::Holder::last;
  return std::make_unique<Torque>(context.record.id, first, last, *axis, data.value, function, holder,
                                  context.nodes.at(last != 0 ? last : first));
}

}  // namespace

ElementType torque_type() {
  deck::Card<TorqueData> card("TORQUE", {"COUPLE"}, "Moment between two nodes, or on one node from the ground");
  card.numbered()
      .chapter("Special boundary conditions and multi-point constraints")
      .describe(
          "The moment V about AXIS acts on the last node, and the opposite moment on the first of two. The axis turns with "
          "the first node (FOLLOW, the default for two nodes) or stays fixed in space (FIXED, the default for one). "
          "FOLLOW with one node: the axis turns with that node.")
      .example("I 5 TORQUE N 3 2  AXIS 0 0 -1  V 1000")
      .example("I 6 TORQUE N 4  AXIS 0 0 1  V -945.8  NF 2");
  card.add("N", &TorqueData::nodes, "one node, or the two nodes a and b; 0 is the ground")
      .synonyms({"NODES", "NOEUDS"})
      .values(1, 2)
      .refers(deck::Reference::node)
      .required();
  card.add("AXIS", &TorqueData::axis, "direction of the axis, in the reference configuration").synonyms({"AXE"}).required();
  card.add("V", &TorqueData::value, "moment").synonyms({"VAL"}).unit(dimension::moment).required();
  card.add("NF", &TorqueData::function, "function of time that multiplies V").refers(deck::Reference::function).at_least(0);
  card.add("FOLLOW", &TorqueData::follow, "the axis turns with the first node").synonyms({"SUIVEUR"});
  card.add("FIXED", &TorqueData::fixed, "the axis is fixed in space").synonyms({"FIXE"});
  return element_type(card, build);
}

}  // namespace engrane::elements::loads
