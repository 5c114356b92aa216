// SPDX-License-Identifier: BSD-3-Clause
#include "elements/inertia.hpp"

#include "elements/building.hpp"
#include "elements/carried_body.hpp"

namespace engrane {

namespace {

std::unique_ptr<Element> build(const InertiaData& data, BuildContext& context) {
  const auto tensor = inertia_tensor(context, data.tensor);
  if (!check_nodes(context, {data.node}) || !tensor) return nullptr;
  if (data.mass == 0 && tensor->isZero(0)) {
    context.error("M", "an INERTIA with neither mass nor moment of inertia does nothing", "M mass and J moments of inertia");
    return nullptr;
  }
  Vec3 offset = to_vector(data.offset);
  if (data.mass == 0) offset.setZero();  // a couple-like body: where it sits on the node makes no difference
  return std::make_unique<CarriedBody>(context.record.id, data.node, BodyInertia{data.mass, offset, *tensor});
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
