// SPDX-License-Identifier: BSD-3-Clause
#include "elements/structural/cell.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "elements/structural/cell_book.hpp"
#include "elements/structural/plane_cells.hpp"

namespace engrane::elements::structural {

namespace {

/// Reports what is wrong with the list of nodes; they are then nothing.
std::optional<std::vector<int>> nodes_of(const CellData& data, BuildContext& context) {
  auto nodes = ordered_nodes(data);
  if (!nodes) {
    const auto corners = std::count_if(data.nodes.begin(), data.nodes.end(), [](int n) { return n > 0; });
    const auto middles = static_cast<long>(data.nodes.size()) - corners;
    std::string what = fmt::format("a cell of {} corners and {} mid-side nodes is not in this version", corners, middles);
    if ((corners == 3 || corners == 4) && middles > 0)
      what = middles == corners ? "mid-side nodes do not stand between their corners"
                                : fmt::format("{} of {} mid-side nodes are missing", corners - middles, corners);
    context.error("N", what, "N n1 n2 n3 [n4], or N n1 -m12 n2 -m23 n3 -m31, mid-side nodes below zero between their corners");
    return {};
  }
  for (std::size_t i = 0; i < nodes->size(); ++i) {
    const int id = (*nodes)[i];
    if (id == 0 || !context.nodes.contains(id)) {
      context.diagnostics.missing(".NOE", context.record.where("N"),
                                  fmt::format("node {} of cell {} does not exist", id, context.record.id));
      return {};
    }
    if (std::find(nodes->begin(), nodes->begin() + static_cast<std::ptrdiff_t>(i), id) !=
        nodes->begin() + static_cast<std::ptrdiff_t>(i)) {
      context.error("N", fmt::format("node {} is named twice", id), "each corner and each middle of a side is a node of its own");
      return {};
    }
  }
  return nodes;
}

std::unique_ptr<Element> build(const CellData& data, BuildContext& context) {
  const auto nodes = nodes_of(data, context);
  const std::shared_ptr<const CellSection> section = CellBook::of(context)->section(context.record.id);
  if (!nodes || !section) return nullptr;
  std::vector<Eigen::Vector2d> places;
  const double height = context.nodes.at(nodes->front())[2];
  double size = 0;
  for (const int id : *nodes) {
    places.emplace_back(context.nodes.at(id).head<2>());
    size = std::max(size, (places.back() - places.front()).norm());
  }
  for (const int id : *nodes)
    if (std::abs(context.nodes.at(id)[2] - height) > 1e-9 * size) {
      context.error("N", fmt::format("cell {} does not lie in a plane of constant z", context.record.id),
                    "cells of this version are of the plane: give all of their nodes the same Z");
      return nullptr;
    }
  if (!has_area(places)) {
    context.error("N", fmt::format("cell {} is turned inside out, or has no area", context.record.id),
                  "its corners must go round it in turn, and a middle of a side must be near the middle");
    return nullptr;
  }
  if (section->hypothesis == materials::Hypothesis::axisymmetric &&
      std::any_of(places.begin(), places.end(), [size](const auto& x) { return x[0] < -1e-9 * size; })) {
    context.error("N", fmt::format("cell {} reaches over the axis", context.record.id),
                  "of an axisymmetric cell x is the radius, and y the axis: no node has a negative X");
    return nullptr;
  }
  return make_plane_cell(context.record.id, *nodes, places, section, context.blocks);
}

}  // namespace

std::optional<std::vector<int>> ordered_nodes(const CellData& data) {
  const auto middle = [](int n) { return n < 0; };
  const auto middles = std::count_if(data.nodes.begin(), data.nodes.end(), middle);
  const std::size_t corners = data.nodes.size() - static_cast<std::size_t>(middles);
  if (corners < 3 || corners > 4) return {};
  if (middles == 0) return data.nodes;
  if (static_cast<std::size_t>(middles) != corners) return {};
  std::vector<int> nodes;
  for (std::size_t i = 0; i < data.nodes.size(); i += 2) {
    if (middle(data.nodes[i]) || !middle(data.nodes[i + 1])) return {};
    nodes.push_back(data.nodes[i]);
  }
  for (std::size_t i = 1; i < data.nodes.size(); i += 2) nodes.push_back(-data.nodes[i]);
  return nodes;
}

ElementType cell_type() {
  deck::Card<CellData> card(".MAI", {".MAILLES", ".CELLS"}, "Cells of a mesh: plane cells of 3, 6, 4 or 8 nodes");
  card.numbered()
      .chapter("Meshes")
      .describe(
          "Corners stand in turn, either way round; a mid-side node is below zero and stands between its corners. What a cell is "
          "comes from `.HYP` (plane stress, plane strain, axisymmetric), `.PHP` (thickness) and `.AEL` (its `.MAT`). Its nodes "
          "move along x and y. Without `.SAM TYPE` and `.SUB` the analysis is linear statics in one step.")
      .example(".MAI\n I 1 AT 1 0 N 1 8 9 2\n I 2 AT 1 0 N 9 -24 11 -25 13 -26");
  card.add("AT", &CellData::attribute, "attribute by which `.SEL` may choose cells; a 0 behind it separates it from N")
      .synonyms({"ATTRIBUTE", "ATTRIBUT"})
      .values(1, 3);
  card.add("N", &CellData::nodes, "nodes").synonyms({"NODES", "NOEUDS"}).values(3, 27).required();
  return element_type(card, build);
}

}  // namespace engrane::elements::structural
