// SPDX-License-Identifier: BSD-3-Clause
#include "elements/membranes/membrane.hpp"

#include <fmt/format.h>

#include "elements/common/building.hpp"
#include "elements/common/material.hpp"
#include "elements/membranes/membrane_cells.hpp"
#include "elements/structural/cell_material.hpp"

namespace engrane::elements::membranes {

namespace {

std::optional<CellShape> shape_of(std::size_t nodes) {
  switch (nodes) {
    case 3:
      return CellShape::triangle;
    case 4:
      return CellShape::quadrilateral;
    case 6:
      return CellShape::triangle6;
    case 8:
      return CellShape::quadrilateral8;
    default:
      return {};
  }
}

std::unique_ptr<Element> build(const MembraneData& data, BuildContext& context) {
  if (!check_nodes(context, data.nodes)) return nullptr;
  const auto shape = shape_of(data.nodes.size());
  if (!shape) {
    context.error("N", fmt::format("a membrane of {} nodes", data.nodes.size()),
                  "3 or 4 corners in turn; then, of all sides or none, the middles, from that of the first side on");
    return nullptr;
  }
  if (data.pressure == 0 && data.function != 0) {
    context.error("NF", "NF without PRESSURE", "PRESSURE p, which the function multiplies");
    return nullptr;
  }
  const Function* function = nullptr;
  const bool found = find_function(context, data.function, function);
  // isotropic only: the frames at the points of a curved surface do not define material axes
  if (!isotropic_material(context, data.material, "membranes") || !found) return nullptr;
  const auto material =
      structural::elastic_of(*material_record(context, data.material), materials::Hypothesis::plane_stress, context.diagnostics);
  if (!material) return nullptr;
  if (material->damping > 0) {
    context.error("MAT", fmt::format("material {} has DAMPING, and membranes have none", data.material),
                  "a .MAT without DAMPING; BEAMs and BARs along the membrane can damp it");
    return nullptr;
  }
  if (!data.wrinkling && context.record.given("SLACK")) {
    context.error("SLACK", "SLACK without WRINKLING", "WRINKLING, which leaves this part of the stiffness");
    return nullptr;
  }
  if (data.wrinkling && data.tension < 0) {
    context.error("TENSION", "a skin that wrinkles cannot be pressed in its reference configuration", "TENSION of 0 or more");
    return nullptr;
  }
  MembraneSection section{membrane_law(materials::law_of(materials::Hypothesis::plane_stress, *material)), material->density,
                          data.thickness, data.pressure, function};
  section.law.tension = data.tension;
  if (data.wrinkling) section.law.wrinkling = data.slack;
  std::vector<Vec3> places;
  for (const int node : data.nodes) places.push_back(context.nodes.at(node));
  const NodeWarmth warmth = warmth_of(data.nodes, section.law.expansion != 0, "membrane", context);
  auto membrane = make_membrane(context.record.id, *shape, data.nodes, places,
                                std::make_shared<const MembraneSection>(std::move(section)), warmth, context.blocks);
  if (!membrane)
    context.error("N", fmt::format("membrane {} is folded over, or has no area", context.record.id),
                  "its corners must go round it in turn, and a middle of a side must be near the middle");
  return membrane;
}

}  // namespace

ElementType membrane_type() {
  deck::Card<MembraneData> card("MEMBRANE", {}, "Membrane: a skin in space that strains in its surface only");
  card.numbered()
      .chapter("Meshes")
      .describe(
          "Three or four corners in turn, then, for a membrane with curved sides, the middles of all sides from that of the "
          "first "
          "on. It stands relaxed where it is, or under the stress TENSION in all directions. It has no stiffness against "
          "bending, and a flat one none across itself but by its tension. The material is isotropic: elastic, or neo-Hookean "
          "for strains of any size. The pressure stays normal to the surface and grows with it; above 0 it pushes to the side "
          "from which the corners go round counterclockwise.")
      .example("I 1 MEMBRANE N 1 2 5 4  MAT 1 THICK 2D-3  PRESSURE 500. NF 1")
      .example("I 2 MEMBRANE N 1 3 5 2 4 6  MAT 1 THICK 2D-3  TENSION 1D4  WRINKLING");
  card.add("N", &MembraneData::nodes, "corners in turn, then the middles of the sides: 3, 4, 6 or 8 nodes")
      .synonyms({"NODES", "NOEUDS"})
      .refers(deck::Reference::node)
      .at_least(1)
      .values(3, 8)
      .required();
  card.add("MAT", &MembraneData::material, "number of the material in `.MAT`").synonyms({"MATERIAL", "MATERIAU"}).required();
  card.add("THICK", &MembraneData::thickness, "thickness").synonyms({"EPAISSEUR"}).unit(dimension::length).positive().required();
  card.add("TENSION", &MembraneData::tension, "stress in all directions of the surface, in the reference configuration")
      .unit(dimension::pressure);
  card.add("WRINKLING", &MembraneData::wrinkling, "carries no compression: it wrinkles").synonyms({"PLIS"});
  card.add("SLACK", &MembraneData::slack, "part of its stiffness that is left where it wrinkles").at_least(0).at_most(1);
  card.add("PRESSURE", &MembraneData::pressure, "pressure that follows the surface").synonyms({"PRE"}).unit(dimension::pressure);
  card.add("NF", &MembraneData::function, "function of time that PRESSURE is multiplied by; default: none")
      .refers(deck::Reference::function);
  return element_type(card, build);
}

}  // namespace engrane::elements::membranes
