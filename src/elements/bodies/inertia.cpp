// SPDX-License-Identifier: BSD-3-Clause
#include "elements/bodies/inertia.hpp"

#include <fmt/format.h>

#include "elements/bodies/carried_body.hpp"
#include "elements/common/building.hpp"

namespace engrane::elements::bodies {

namespace {

/// JSON of the disc of OUTER and WIDTH about the centre of mass, empty if not given. Returns nullopt, with an error, if
/// invalid.
std::optional<std::string> disc(const InertiaData& data, const BuildContext& context, const Vec3& center) {
  if (!data.outer) {
    for (const auto& [keyword, given] :
         {std::pair{"WIDTH", data.width.has_value()}, {"INNER", data.inner.has_value()}, {"AXIS", data.axis.has_value()}})
      if (given) {
        context.error(keyword, fmt::format("{} without OUTER", keyword), "a disc in pictures has OUTER, its diameter, and WIDTH");
        return {};
      }
    return "";
  }
  if (!data.width) {
    context.error("OUTER", "OUTER without WIDTH", "a disc in pictures has a diameter and a width");
    return {};
  }
  const double inner = data.inner.value_or(0);
  if (!(inner < *data.outer)) {
    context.error("INNER", fmt::format("a disc with a diameter of {} has a hole of {}", number(*data.outer), number(inner)),
                  "INNER is below OUTER");
    return {};
  }
  Vec3 axis = data.axes.empty() ? Vec3::UnitX() : Vec3(Vec3(data.axes[0], data.axes[1], data.axes[2]).normalized());
  if (data.axis) {
    const auto given = unit_vector(context, "AXIS", *data.axis);
    if (!given) return {};
    axis = *given;
  }
  return fmt::format(R"("shape": "disc", "node": {}, "center": {}, "axis": {}, "outer": {}, "inner": {}, "width": {})", data.node,
                     json(center), json(axis), number(*data.outer), number(inner), number(*data.width));
}

std::unique_ptr<Element> build(const InertiaData& data, BuildContext& context) {
  if (!check_nodes(context, {data.node})) return nullptr;
  const Vec3 node = context.nodes.at(data.node);
  auto body = one_body(context, {{data.mass}, {node + to_vector(data.offset)}, data.tensor, data.axes, data.about}, node);
  if (!body) return nullptr;
  if (data.mass == 0 && body->tensor.isZero(0)) {
    context.error("M", "an INERTIA with neither mass nor moment of inertia does nothing", "M mass and J moments of inertia");
    return nullptr;
  }
  body->offset = data.mass > 0 ? to_vector(data.offset) : Vec3(Vec3::Zero());  // without mass the offset has no effect
  auto drawing = disc(data, context, node + body->offset);
  if (!drawing) return nullptr;
  return std::make_unique<CarriedBody>(context.record.id, data.node, *body, std::move(*drawing));
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
          "axes, ABOUT another point. `engrane inertia part.stl` finds all of it from a mesh. Pictures show a ball, "
          "or the disc of OUTER and WIDTH, which say nothing of the mass.")
      .example("I 8 INERTIA N 2  M 5.36D-3  J 0.0102")
      .example("I 9 INERTIA N 3  M 2  J 0.1 0.2 0.25  OFFSET 0.5 0 0  AXES 1 1 0 -1 1 0")
      .example("I 10 INERTIA N 4  M 5  J 0.02 0.01 0.01  OUTER 0.18 WIDTH 0.03");
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
  card.add("OUTER", &InertiaData::outer, "diameter of a disc in pictures, about the centre of mass")
      .unit(dimension::length)
      .positive();
  card.add("WIDTH", &InertiaData::width, "its width").synonyms({"LARGEUR"}).unit(dimension::length).positive();
  card.add("INNER", &InertiaData::inner, "diameter of its hole").unit(dimension::length).at_least(0);
  card.add("AXIS", &InertiaData::axis, "its axis; by itself the first axis of J").synonyms({"AXE"});
  return element_type(card, build);
}

}  // namespace engrane::elements::bodies
