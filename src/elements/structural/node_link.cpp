// SPDX-License-Identifier: BSD-3-Clause
#include "elements/structural/node_link.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <unordered_set>

#include "elements/structural/cell.hpp"
#include "elements/structural/cell_book.hpp"
#include "elements/structural/cell_topology.hpp"

namespace engrane::elements::structural {

namespace {

/// Properties of the deck's cells that links need.
struct LinkedMesh {
  std::unordered_set<int> ids;  ///< nodes of plane cells only, which do not move along z
  bool small = false;           ///< small displacements

  explicit LinkedMesh(const BuildContext& context) {
    if (!context.records) return;
    small = deck::has_small_displacements(*context.records);
    std::unordered_set<int> in_space;
    const std::shared_ptr<const CellBook> book = CellBook::of(context);
    for (const deck::Record& record : *context.records)
      if (const auto* data = record.get<CellData>())
        if (const auto cell = connectivity(data->nodes)) {
          const auto section = is_solid(cell->shape) ? nullptr : book->section(record.id);
          const bool solid = is_solid(cell->shape) || (section && section->skin);
          (solid ? in_space : ids).insert(cell->nodes.begin(), cell->nodes.end());
        }
    for (const int id : in_space) ids.erase(id);
  }
};

}  // namespace

std::optional<LinkedGroup> linked_group(const LinkData& data, BuildContext& context) {
  if (data.nodes.empty() && data.groups.empty()) {
    context.error("N", fmt::format("node {} is linked to nothing", data.master), "name a GROUP of nodes, or MEMBERS");
    return {};
  }
  LinkedGroup group;
  if (context.nodes_of)
    group.nodes = context.nodes_of(data);
  else
    group.nodes = data.nodes;
  if (group.nodes.empty()) return {};  // reported when the group was resolved
  if (std::find(group.nodes.begin(), group.nodes.end(), data.master) != group.nodes.end()) {
    context.error("N", fmt::format("node {} belongs to the group that is linked to it", data.master),
                  "link the group to a node of its own, which may be in the same place");
    return {};
  }
  const Vec3 master = context.nodes.at(data.master);
  for (const int id : group.nodes) group.places.push_back(context.nodes.at(id) - master);
  BuildNotes alone;
  const auto& mesh = (context.notes ? *context.notes : alone).get<LinkedMesh>([&] { return LinkedMesh(context); });
  group.small = mesh.small;
  const auto other = std::find_if(group.nodes.begin(), group.nodes.end(), [&](int id) { return !mesh.ids.contains(id); });
  const bool in_plane = other == group.nodes.end();
  if (in_plane) group.height = context.nodes.at(group.nodes.front())[2];
  const auto flat = std::find_if(group.nodes.begin(), group.nodes.end(), [&](int id) { return mesh.ids.contains(id); });
  if (!in_plane && flat != group.nodes.end()) {
    context.error("N", fmt::format("node {} of the group is one of plane cells, node {} is not", *flat, *other),
                  "link them by two links");
    return {};
  }
  return group;
}

Layout link_layout(bool in_plane, std::vector<Multiplier> multipliers) {
  Layout layout;
  layout.nodes = {-1, -1};
  layout.needs = {NodeNeed::both, in_plane ? NodeNeed::in_plane : NodeNeed::translation};
  layout.multipliers = std::move(multipliers);
  return layout;
}

}  // namespace engrane::elements::structural
