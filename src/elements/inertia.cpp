// SPDX-License-Identifier: BSD-3-Clause
#include "elements/inertia.hpp"

#include <fmt/format.h>

#include "elements/body_inertia.hpp"
#include "elements/building.hpp"
#include "model/templated_element.hpp"

namespace engrane {

namespace {

class Inertia final : public TemplatedElement<Inertia, 1, 6> {
 public:
  Inertia(int id, int node, const BodyInertia& body) : TemplatedElement(id), body_(body), channels_(body_channels(body)) {
    Layout layout;
    layout.nodes = {node};
    layout.needs = {!body.turns() ? NodeNeed::translation : body.mass == 0 ? NodeNeed::rotation : NodeNeed::both};
    set_layout(std::move(layout));
  }

  template <class T>
  void evaluate(const Motion<T, 1>& motion, const State& state, Balance<T, 1>& balance) const {
    const auto resistance = body_.resistance<T>(motion.node[0], state.gravity);
    balance.force(0, resistance.force);
    balance.moment(0, resistance.moment);
  }

  Energies energies(const State& state) const override { return body_.energies(state.nodes[0], state.gravity); }

  Mat3 inertia_at(int node) const override { return node == layout().nodes[0] ? body_.about_node() : Mat3(Mat3::Zero()); }

  const std::vector<Named>& channels() const override { return channels_; }
  void observe(const State& state, std::span<double> values) const override { observe_body(body_, state.nodes[0], values); }

  Drawing drawing() const override { return {fmt::format(R"("shape": "mass", "node": {})", layout().nodes[0])}; }

 private:
  BodyInertia body_;
  std::vector<Named> channels_;
};

std::unique_ptr<Element> build(const InertiaData& data, BuildContext& context) {
  const auto tensor = inertia_tensor(context, data.tensor);
  if (!check_nodes(context, {data.node}) || !tensor) return nullptr;
  if (data.mass == 0 && tensor->isZero(0)) {
    context.error("M", "an INERTIA with neither mass nor moment of inertia does nothing", "M mass and J moments of inertia");
    return nullptr;
  }
  Vec3 offset = to_vector(data.offset);
  if (data.mass == 0) offset.setZero();  // a couple-like body: where it sits on the node makes no difference
  return std::make_unique<Inertia>(context.record.id, data.node, BodyInertia{data.mass, offset, *tensor});
}

}  // namespace

ElementType inertia_type() {
  deck::Card<InertiaData> card("INERTIA", {"INERTIE"}, "Mass and inertia tensor on a node");
  card.numbered()
      .chapter("Rigid kinematic joints")
      .describe(
          "The node gets rotations only when J or OFFSET is given. J is about the centre of mass, in axes that are the "
          "global ones in the reference configuration and turn with the node: one value is the same about all axes, three "
          "are about x, y and z, six are Jxx Jyy Jzz Jxy Jyz Jzx of the tensor (Jxy = -integral of xy).")
      .example("I 8 INERTIA N 2  M 5.36D-3  J 0.0102");
  card.add("N", &InertiaData::node, "the node")
      .synonyms({"NODE", "NODES", "NOEUD", "NOEUDS"})
      .refers(deck::Reference::node)
      .required();
  card.add("M", &InertiaData::mass, "mass").synonyms({"MASS", "MASSE"}).unit(dimension::mass).at_least(0);
  card.add("J", &InertiaData::tensor, "moments of inertia about the centre of mass: 1, 3 or 6 values")
      .values(1, 6)
      .unit(dimension::inertia);
  card.add("OFFSET", &InertiaData::offset, "from the node to the centre of mass").unit(dimension::length);
  return element_type(card, build);
}

}  // namespace engrane
