// SPDX-License-Identifier: BSD-3-Clause
#include "elements/structural/cell.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "elements/beams/make_beam.hpp"
#include "elements/structural/cell_book.hpp"
#include "elements/structural/cell_topology.hpp"
#include "elements/structural/make_cell.hpp"

namespace engrane::elements::structural {

namespace {

constexpr const char* how_plane =
    "N n1 n2 n3 [n4], or N n1 -m12 n2 -m23 n3 -m31, mid-side nodes below zero between their corners";
constexpr const char* how_solid =
    "N base 0 top, as 1 2 3 0 4, 1 2 3 0 4 5 6 or 1 2 3 4 0 5 6 7 8; with mid-side nodes N base 0 uprights 0 top";

/// Whether all nodes of a cell exist and are distinct; otherwise reports an error.
bool has_nodes(const std::vector<int>& nodes, BuildContext& context) {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const int id = nodes[i];
    if (!context.nodes.contains(id)) {
      context.diagnostics.missing(".NOE", context.record.where("N"),
                                  fmt::format("node {} of cell {} does not exist", id, context.record.id));
      return false;
    }
    const auto end = nodes.begin() + static_cast<std::ptrdiff_t>(i);
    if (std::find(nodes.begin(), end, id) != end) {
      context.error("N", fmt::format("node {} is named twice", id), "each corner and each middle of a side is a node of its own");
      return false;
    }
  }
  return true;
}
constexpr const char* how_skin = "its corners must go round it in turn, and a middle of a side must be near the middle";

/// Shape and nodes of a cell. Reports an error and returns nothing if the list of nodes is invalid.
std::optional<Connectivity> nodes_of(const CellData& data, BuildContext& context) {
  auto cell = connectivity(data.nodes);
  if (!cell) {
    const bool solid = std::find(data.nodes.begin(), data.nodes.end(), 0) != data.nodes.end();
    const auto corners = std::count_if(data.nodes.begin(), data.nodes.end(), [](int n) { return n > 0; });
    const auto middles = std::count_if(data.nodes.begin(), data.nodes.end(), [](int n) { return n < 0; });
    std::string what = fmt::format("a {} of {} corners and {} mid-side nodes is not in this version", solid ? "solid" : "cell",
                                   corners, middles);
    if (!solid && (corners == 3 || corners == 4) && middles > 0)
      what = middles == corners ? "mid-side nodes do not stand between their corners"
                                : fmt::format("{} of {} mid-side nodes are missing", corners - middles, corners);
    context.error("N", what, solid ? how_solid : how_plane);
    return {};
  }
  if (!has_nodes(cell->nodes, context)) return {};
  return cell;
}

/// Whether the position and shape of a plane cell are valid; otherwise reports an error.
bool fits_plane(const CellPlan& plan, BuildContext& context) {
  double size = 0;
  for (const Vec3& x : plan.places) size = std::max(size, (x - plan.places.front()).head<2>().norm());
  const double near = 1e-9 * size;
  const auto any = [&plan](const auto& is) { return std::any_of(plan.places.begin(), plan.places.end(), is); };
  if (any([&](const Vec3& x) { return std::abs(x[2] - plan.places.front()[2]) > near; }))
    context.error("N", fmt::format("cell {} does not lie in a plane of constant z", plan.id),
                  "plane cells lie in the plane of x and y: give all of their nodes the same Z");
  else if (!is_regular_plane(plan.shape, plan.places))
    context.error("N", fmt::format("cell {} is turned inside out, or has no area", plan.id),
                  "its corners must go round it in turn, and a middle of a side must be near the middle");
  else if (plan.section->hypothesis == materials::Hypothesis::axisymmetric && any([near](const Vec3& x) { return x[0] < -near; }))
    context.error("N", fmt::format("cell {} reaches over the axis", plan.id),
                  "of an axisymmetric cell x is the radius, and y the axis: no node has a negative X");
  else
    return true;
  return false;
}

/// Whether the centrifugal load of a cell has no component out of its plane; otherwise reports an error. Also warns, once per
/// model, about cells without density.
bool fits_rotation(const CellPlan& plan, BuildContext& context) {
  const CellRotation& turn = *plan.rotation;
  if (plan.section->law.density == 0)
    context.diagnostics.warning_once("turn", turn.record->location, "cells without density: ROT has no effect on them",
                                     "M of .MAT is the density");
  if (is_solid(plan.shape)) return true;
  const bool axi = plan.section->hypothesis == materials::Hypothesis::axisymmetric;
  double size = 0, off = 0;
  for (const Vec3& x : plan.places) {
    const Vec3 arm = x - turn.point;
    size = std::max(size, arm.norm());
    off = std::max(off, std::abs((turn.projection() * arm)[2]));
  }
  if (axi) off = std::hypot(turn.axis[0], turn.axis[2]) * size + std::hypot(turn.point[0], turn.point[2]);
  if (off <= 1e-9 * size) return true;
  context.diagnostics.error(
      turn.record->where("AXE"),
      axi ? "axisymmetric cells turn about another axis than their own" : "ROT pushes plane cells out of their plane",
      axi ? "AXE 0 1 0, and AT on the y axis or left out" : "AXE 0 0 1, or an axis in the plane of the cells");
  return false;
}

std::unique_ptr<Element> build_beam(const std::vector<int>& nodes, BuildContext& context) {
  const std::optional<BeamCell> cell = CellBook::of(context)->beam(context.record.id);
  if (!has_nodes(nodes, context) || !cell) return nullptr;
  beams::BeamOptions options;
  options.sections.profile = cell->profile;
  options.sections.material = cell->material;
  options.axis_2 = cell->axis_2;
  options.small = cell->linear;
  options.lumped = cell->lumped;
  return beams::make_beam({nodes, false}, options, context);
}

std::unique_ptr<Element> build(const CellData& data, BuildContext& context) {
  if (const auto line = line_of(data.nodes)) return build_beam(*line, context);
  auto cell = nodes_of(data, context);
  const std::shared_ptr<const CellSection> section = CellBook::of(context)->section(context.record.id);
  if (!cell || !section) return nullptr;
  CellPlan plan{context.record.id, cell->shape, std::move(cell->nodes), {}, section};
  for (const int id : plan.nodes) plan.places.push_back(context.nodes.at(id));
  plan.warmth = warmth_of(plan.nodes, !section->law.expansion.isZero(0), "cell", context);
  if (section->skin) {
    auto skin = make_skin(plan, context.blocks);
    if (!skin) context.error("N", fmt::format("membrane {} is folded over, or has no area", plan.id), how_skin);
    return skin;
  }
  plan.rotation = CellBook::of(context)->rotation(plan.id);
  if (plan.rotation && !fits_rotation(plan, context)) return nullptr;
  if (!is_solid(plan.shape)) return fits_plane(plan, context) ? make_plane_cell(plan, context.blocks) : nullptr;
  if (is_regular_solid(plan.shape, plan.places)) return make_solid_cell(plan, context.blocks);
  context.error(
      "N", fmt::format("cell {} is turned inside out, or has no volume", plan.id),
      "the corners of its base go round it in turn, those of its top stand over them in the same order, and a middle of "
      "a side must be near the middle");
  return nullptr;
}

}  // namespace

ElementType cell_type() {
  deck::Card<CellData> card(
      ".MAI", {".MAILLES", ".CELLS"},
      "Cells of a mesh: beams of 2 or 3 nodes, plane cells of 3, 6, 4 or 8, solids of 4, 10, 6, 15, 8 or 20");
  card.numbered()
      .chapter("Meshes")
      .describe(
          "Corners stand in turn, either way round; a mid-side node is below zero and stands between its corners. Of a solid the "
          "corners of the base are followed by a 0 and those of the top: `1 2 3 0 4` is a tetrahedron, `1 2 3 0 4 5 6` a wedge, "
          "`1 2 3 4 0 5 6 7 8` a hexahedron. With mid-side nodes those of the sides from base to top stand between two zeros. "
          "`1 2` and `1 -3 2` are beams, as those of BEAM. What a cell is comes from `.HYP` (plane stress, plane strain, "
          "axisymmetric, volume, beam), `.PHP` (thickness) and `.AEL` (its `.MAT`; of beams its `.BPR` and AXIS2). The nodes of "
          "plane cells move along x and y. Without `.SAM TYPE` and `.SUB` the analysis is linear "
          "statics: the equilibrium with all loads, at t = 1.")
      .example(".MAI\n I 1 AT 1 0 N 1 8 9 2\n I 2 AT 1 0 N 9 -24 11 -25 13 -26")
      .example(".MAI FILE \"wheel.mesh.h5\"")
      .example(".MAI\n I 1 N 1 2 3 0 4\n I 2 N 1 -5 2 -6 3 -7 0 -8 -9 -10 0 4");
  card.add_mesh_file("FILE",
                     "a mesh by `engrane import … -o name.mesh.h5`, whose nodes, cells and groups stand for it; relative to "
                     "the folder of the deck")
      .synonyms({"FICHIER"});
  card.add("AT", &CellData::attribute, "attribute by which `.SEL` may choose cells; a 0 behind it separates it from N")
      .synonyms({"ATTRIBUTE", "ATTRIBUT"})
      .values(1, 3);
  card.add("N", &CellData::nodes, "nodes").synonyms({"NODES", "NOEUDS"}).values(2, 27).required();
  card.finish([](CellData&, deck::Record& record, Diagnostics& diagnostics) {
    if (record.given("FILE"))
      diagnostics.error(record.where("FILE"), "FILE stands before the first cell",
                        ".MAI FILE \"wheel.mesh.h5\", then cells of the deck's own");
  });
  return element_type(card, build);
}

}  // namespace engrane::elements::structural
