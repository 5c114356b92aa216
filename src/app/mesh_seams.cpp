// SPDX-License-Identifier: BSD-3-Clause
#include "app/mesh_seams.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "elements/structural/cell_topology.hpp"
#include "elements/structural/group_pressure.hpp"
#include "elements/structural/pressure.hpp"

namespace engrane::app {

namespace {

namespace structural = elements::structural;

/// Calls `use` with the two corners, the smaller first, and the mid-side node, 0 if there is none, of each side of a cell.
template <class Use>
void for_each_side(const Model::Part& part, const Use& use) {
  const CellShape shape = part.element->cell_shape();
  const std::span<const int> nodes = part.element->node_ids();
  const auto sides = structural::sides(shape);
  const auto corners = static_cast<std::size_t>(structural::corner_count(shape));
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const int a = nodes[static_cast<std::size_t>(sides[i].first)], b = nodes[static_cast<std::size_t>(sides[i].second)];
    use(std::minmax(a, b), structural::has_middles(shape) ? nodes[corners + i] : 0);
  }
}

bool has_sides(const Model::Part& part) { return part.is_cell() && part.element->cell_shape() != CellShape::none; }

/// Nodes (indices) that elements with constraints join to others, or supports hold.
std::set<int> held_nodes(const Model& model) {
  std::set<int> held;
  for (const Model::Part& part : model.parts)
    if (!part.element->layout().multipliers.empty()) held.insert(part.nodes.begin(), part.nodes.end());
  std::map<int, int> translations;  // that are supported
  for (const Support& support : model.supports)
    if (support.component < 3 && ++translations[support.node] >= 2) held.insert(support.node);
  return held;
}

/// A face that carries a pressure, and the cells that have it.
struct Pressed {
  const Model::Part* pressure;
  std::vector<int> nodes;  ///< ascending
  std::vector<const Model::Part*> cells = {};
  int face = 0;  ///< its number in the first of the cells
};

bool is_pressure(const Model::Part& part) {
  return part.record && (part.record->get<structural::PressureData>() || part.record->get<structural::GroupPressureData>());
}

std::vector<int> sorted(std::span<const int> nodes) {
  std::vector<int> all(nodes.begin(), nodes.end());
  std::sort(all.begin(), all.end());
  return all;
}

}  // namespace

void warn_of_loose_middles(const Model& model, Diagnostics& diagnostics) {
  const auto has_middles = [](const Model::Part& part) { return structural::has_middles(part.element->cell_shape()); };
  bool some = false, others = false;
  for (const Model::Part& part : model.parts)
    if (has_sides(part)) (has_middles(part) ? some : others) = true;
  if (!some || !others) return;
  std::map<std::pair<int, int>, std::pair<int, const Model::Part*>> middles;  // by the corners of the side
  for (const Model::Part& part : model.parts)
    if (has_sides(part) && has_middles(part))
      for_each_side(part, [&](const std::pair<int, int>& corners, int middle) { middles.try_emplace(corners, middle, &part); });
  const std::set<int> held = held_nodes(model);
  std::map<int, std::pair<const Model::Part*, const Model::Part*>> loose;  // by node: the cell that has it, and one that has not
  for (const Model::Part& part : model.parts) {
    if (!has_sides(part) || has_middles(part)) continue;
    for_each_side(part, [&](const std::pair<int, int>& corners, int) {
      const auto found = middles.find(corners);
      if (found == middles.end() || held.contains(model.node_index(found->second.first))) return;
      loose.try_emplace(found->second.first, found->second.second, &part);
    });
  }
  if (loose.empty()) return;
  const auto& [node, cells] = *loose.begin();
  diagnostics.warning(
      cells.second->location,
      fmt::format("node {} in the middle of a side of cell {} hangs loose{}: cell {} has this side without it", node,
                  cells.first->element->id(), loose.size() > 1 ? fmt::format(" (the first of {})", loose.size()) : "",
                  cells.second->element->id()),
      "give both cells the node, or hold it half way between the corners by .LIA");
}

void warn_of_inner_pressures(const Model& model, Diagnostics& diagnostics) {
  std::vector<Pressed> faces;
  for (const Model::Part& part : model.parts)
    if (is_pressure(part)) faces.push_back({&part, sorted(part.element->node_ids())});
  if (faces.empty()) return;
  // a face is found by its first node
  std::unordered_multimap<int, Pressed*> by_node;
  for (Pressed& face : faces) by_node.emplace(face.nodes.front(), &face);
  for (const Model::Part& part : model.parts) {
    if (!has_sides(part)) continue;
    const std::span<const int> nodes = part.element->node_ids();
    if (std::none_of(nodes.begin(), nodes.end(), [&](int node) { return by_node.contains(node); })) continue;
    const CellShape shape = part.element->cell_shape();
    for (int f = 0; f < structural::face_count(shape); ++f) {
      std::vector<int> own;
      for (const int i : structural::face_nodes(shape, f)) own.push_back(nodes[static_cast<std::size_t>(i)]);
      std::sort(own.begin(), own.end());
      for (auto [at, end] = by_node.equal_range(own.front()); at != end; ++at) {
        Pressed& face = *at->second;
        if (face.nodes != own) continue;
        if (face.cells.empty()) face.face = f + 1;
        face.cells.push_back(&part);
      }
    }
  }
  const Pressed* first = nullptr;
  std::size_t count = 0;
  for (const Pressed& face : faces) {
    if (face.cells.size() < 2) continue;
    if (!first) first = &face;
    ++count;
  }
  if (!first) return;
  const bool solid = structural::is_solid(first->cells.front()->element->cell_shape());
  diagnostics.warning(first->pressure->location,
                      fmt::format("pressure inside the mesh: {} {} of cell {} is one of cell {} too{}", solid ? "face" : "edge",
                                  first->face, first->cells[0]->element->id(), first->cells[1]->element->id(),
                                  count > 1 ? fmt::format(" (the first of {})", count) : ""),
                      "pressures belong on the surface of a mesh");
}

}  // namespace engrane::app
