// SPDX-License-Identifier: BSD-3-Clause
#include "model/node_components.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace engrane {

namespace {

/// Node components that elements use, as NodeNeed flags, one entry per node; 0 if it has no element. Nodal loads are left out:
/// they need the components that they act on, but do not give them to a node.
std::vector<unsigned> needs_of_nodes(const Model& model) {
  std::vector<unsigned> needs(model.nodes.size(), 0);
  for (const Model::Part& part : model.parts)
    for (std::size_t i = 0; i < part.nodes.size() && !part.is_nodal_load(); ++i)
      needs[static_cast<std::size_t>(part.nodes[i])] |= static_cast<unsigned>(part.element->layout().needs[i]);
  return needs;
}

/// Why a component of a node does not exist, for a message.
struct Lack {
  std::string node;        ///< what the node is
  std::string components;  ///< the components that it has
};

/// The reason if a node with these NodeNeed flags lacks a component (0 to 5); nothing if it has it.
std::optional<Lack> lacks(unsigned needs, int component) {
  if (needs == static_cast<unsigned>(NodeNeed::in_plane) && component > 1)
    return Lack{"the node is one of plane cells", "its components are 1 and 2"};
  const bool turns = (needs & static_cast<unsigned>(NodeNeed::rotation)) != 0;
  if (needs != 0 && !turns && component > 2) return Lack{"no element at the node has rotations", "its components are 1, 2 and 3"};
  return {};
}

/// Axis normal to the plane that `.SAM PLANE` names, about which alone nodes turn there (0 to 2); −1: none.
int normal_of(const deck::Tagged& plane) { return plane.is("YZ") ? 0 : plane.is("ZX") ? 1 : plane.is("XY") ? 2 : -1; }

/// The fault of node `id` with `held` of its rotations prescribed, `component` among them and, if two are, `free` not: a finite
/// rotation has no such components.
void report_rotations(const Location& location, int id, int component, int held, int free, Diagnostics& diagnostics) {
  if (held == 1)
    diagnostics.error(
        location,
        fmt::format("node {} has only rotation component {} prescribed, which has no meaning for rotations of any size", id,
                    component),
        "prescribe two or three of the components 4 5 6, or join the node to the ground with a HINGE");
  else if (held == 2)
    diagnostics.error(
        location,
        fmt::format("node {} is turned about one axis (component {}) and free to turn about another (component {}): where that "
                    "leads to would depend on the number of steps",
                    id, component, free),
        "hold the free component, or turn the node by HINGEs on each other, one with a DRIVE");
  else
    diagnostics.error(location, fmt::format("node {} is turned about more than one axis at once", id),
                      "prescribe one rotation and hold the other two at zero");
}

}  // namespace

void check_supports(const Model& model, std::span<const Location> locations, Diagnostics& diagnostics) {
  if (model.supports.empty()) return;
  const std::vector<unsigned> needs = needs_of_nodes(model);
  // a motion in time has rates about the axes of the node; positions of equilibrium would depend on the number of steps
  const bool follows_rates = model.commands.analysis.type.is("DYNAMIC");
  const int normal = normal_of(model.commands.analysis.plane);
  std::vector<std::array<const Support*, 3>> turning(model.nodes.size(), {nullptr, nullptr, nullptr});
  for (const Support& s : model.supports)
    if (s.component > 2) turning[static_cast<std::size_t>(s.node)][static_cast<std::size_t>(s.component - 3)] = &s;
  std::set<int> told;
  for (std::size_t i = 0; i < model.supports.size(); ++i) {
    const Support& s = model.supports[i];
    const auto node = static_cast<std::size_t>(s.node);
    const int id = model.nodes[node].id;
    const std::optional<Lack> lack = lacks(needs[node], s.component);
    if (lack && s.value != 0)
      diagnostics.error(locations[i],
                        fmt::format("component {} of node {} cannot be {}: {}", s.component + 1, id,
                                    s.component < 3 ? "displaced" : "turned", lack->node),
                        lack->components);
    if (lack || needs[node] == 0 || s.component < 3) continue;
    int held = 0, moved = 0, free = 0;
    for (int c = 4; c <= 6; ++c)
      if (const Support* other = turning[node][static_cast<std::size_t>(c - 4)]; other) {
        ++held;
        moved += other->value != 0;
      } else {
        free = c;
      }
    const bool about_normal = held == 1 && s.component - 3 == normal;
    const bool wrong =
        (held == 1 && !about_normal) || (held == 3 && s.value != 0 && moved > 1) || (held == 2 && s.value != 0 && !follows_rates);
    if (wrong && told.insert(s.node).second) report_rotations(locations[i], id, s.component + 1, held, free, diagnostics);
  }
}

void check_nodal_loads(const Model& model, Diagnostics& diagnostics) {
  if (std::none_of(model.parts.begin(), model.parts.end(), [](const Model::Part& part) { return part.is_nodal_load(); })) return;
  const std::vector<unsigned> needs = needs_of_nodes(model);
  std::set<std::pair<int, int>> supported;  // node and component
  for (const Support& s : model.supports) supported.emplace(s.node, s.component);
  std::set<std::pair<int, int>> told;  // file and line
  for (const Model::Part& part : model.parts) {
    if (!part.is_nodal_load()) continue;
    const int node = part.nodes.front();
    // a load with a moment needs all translations
    for (const int component : {5, 4, 3, 2}) {
      // a support takes the load
      if (!part.element->layout().has(0, component) || supported.count({node, component}) != 0) continue;
      const std::optional<Lack> lack = lacks(needs[static_cast<std::size_t>(node)], component);
      if (!lack || !told.insert({part.location.file, part.location.line}).second) continue;
      diagnostics.error(part.location,
                        fmt::format("{} on node {}: {}", component < 3 ? "a force along z cannot act" : "a moment cannot act",
                                    model.node(node).id, lack->node),
                        lack->components);
    }
  }
}

void check_stops(const Model& model, Diagnostics& diagnostics) {
  const auto is_stop = [](const Model::Part& part) { return part.type == "STOP"; };
  if (std::none_of(model.parts.begin(), model.parts.end(), is_stop)) return;
  std::vector<bool> turns(model.nodes.size(), false), moves(turns);
  for (const Model::Part& part : model.parts)
    for (std::size_t i = 0; i < part.nodes.size() && !is_stop(part) && !part.is_nodal_load(); ++i) {
      const auto node = static_cast<std::size_t>(part.nodes[i]);
      moves[node] = true;
      turns[node] = turns[node] || part.element->layout().needs_any(i, NodeNeed::rotation);
    }
  for (const Support& s : model.supports)
    if (s.component > 2) turns[static_cast<std::size_t>(s.node)] = true;
  for (const Model::Part& part : model.parts)
    for (std::size_t i = 0; i < part.nodes.size() && is_stop(part); ++i) {
      const int node = part.nodes[i];
      const auto at = static_cast<std::size_t>(node);
      if (node == 0 || turns[at] || !moves[at] || !part.element->layout().needs_any(i, NodeNeed::rotation)) continue;
      const int id = model.node(node).id;
      diagnostics.error(
          part.location,
          fmt::format("node {} of the stop has no rotations, as those of cells and masses at a point: it cannot hold "
                      "a plane, an axis or a point off the node",
                      id),
          fmt::format("name first the node 0 or one with rotations, which MEAN_LINK and RIGID_LINK join to cells; or "
                      "FIX the components 4 5 6 of node {}, whose plane then keeps its direction",
                      id));
    }
}

void check_initial_values(const Model& model, std::span<const Location> locations, Diagnostics& diagnostics) {
  if (model.initial.empty()) return;
  const std::vector<unsigned> needs = needs_of_nodes(model);
  std::set<std::pair<int, int>> told;  // file and line
  for (std::size_t i = 0; i < model.initial.size(); ++i) {
    const InitialValue& value = model.initial[i];
    const auto node = static_cast<std::size_t>(value.node);
    const std::optional<Lack> lack = lacks(needs[node], value.component);
    if (!lack || value.value == 0 || !told.insert({locations[i].file, locations[i].line}).second) continue;
    const std::string spin = value.velocity && value.component > 2 ? "; to spin a body of cells, give VIT … AXIS 0 0 1 V …" : "";
    diagnostics.error(locations[i],
                      fmt::format("component {} of node {} cannot have an initial value: {}", value.component + 1,
                                  model.nodes[node].id, lack->node),
                      lack->components + spin);
  }
}

}  // namespace engrane
