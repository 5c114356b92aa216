// SPDX-License-Identifier: BSD-3-Clause
#include "elements/bodies/inertia.hpp"

#include "elements/bodies/carried_body.hpp"
#include "elements/common/building.hpp"

namespace engrane::elements::bodies {

namespace {

std::unique_ptr<Element> build(const InertiaData& data, BuildContext& context) {
  if (!check_nodes(context, {data.node})) return nullptr;
  const Vec3 node = context.nodes.at(data.node);
  auto body = one_body(context, {{data.mass}, {node + to_vector(data.offset)}, data.tensor, data.axes, data.about}, node);
  if (!body) return nullptr;
  if (data.mass == 0 && body->tensor.isZero(0)) {
    context.error("M", "an INERTIA with neither mass nor moment of inertia does nothing", "M mass and J moments of inertia");
    return nullptr;
  }
  body->offset = data.mass > 0 ? to_vector(data.offset) : Vec3(Vec3::Zero());  // without mass its place makes no difference
  return std::make_unique<CarriedBody>(context.record.id, data.node, *body);
}

}  // namespace

ElementType inertia_type() {
  deck::Card<InertiaData> card("INERTIA", {"INERTIE"}, "Mass and inertia tensor on a node");
  card.numbered()
      .chapter("Rigid kinematic joints")
      .describe(
          "The node gets rotations only when J or OFFSET is given. J is about the centre of mass, in axes that are the "
          "global ones in the reference configuration and turn with the node: one value is the same about all axes, three "
          "are about x, y and z, six are Jxx Jyy Jzz Jxy Jyz Jzx of the tensor (Jxy = -integral of xy). AXES gives J other "
          "axes, ABOUT another point. `engrane inertia part.stl` finds all of it from a mesh.")
      .example("I 8 INERTIA N 2  M 5.36D-3  J 0.0102")
      .example("I 9 INERTIA N 3  M 2  J 0.1 0.2 0.25  OFFSET 0.5 0 0  AXES 1 1 0 -1 1 0");
  card.add("N", &InertiaData::node, "the node")
      .synonyms({"NODE", "NODES", "NOEUD", "NOEUDS"})
      .refers(deck::Reference::node)
      .required();
  card.add("M", &InertiaData::mass, "mass").synonyms({"MASS", "MASSE"}).unit(dimension::mass).at_least(0);
  card.add("J", &InertiaData::tensor, "moments of inertia about the centre of mass: 1, 3 or 6 values")
      .values(1, 6)
      .unit(dimension::inertia);
  card.add("OFFSET", &InertiaData::offset, "from the node to the centre of mass").unit(dimension::length);
  card.add("AXES", &InertiaData::axes, "first axis of J, and a direction on the side of its second; default: global x and y")
      .values(6, 6);
  card.add("ABOUT", &InertiaData::about, "the point about which J is, in the reference configuration; default: centre of mass")
      .values(3, 3)
      .unit(dimension::length);
  return element_type(card, build);
}

}  // namespace engrane::elements::bodies
