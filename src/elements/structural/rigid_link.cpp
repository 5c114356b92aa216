// SPDX-License-Identifier: BSD-3-Clause
#include "elements/structural/rigid_link.hpp"

namespace engrane::elements::structural {

namespace {

/// Builds one element per node of the group, each with its own multipliers.
std::unique_ptr<Element> build(const RigidLinkData& data, BuildContext& context) {
  const auto group = linked_group(data, context);
  if (!group) return nullptr;
  std::vector<Multiplier> multipliers;
  for (const char* name : {"FORCE_X", "FORCE_Y", "FORCE_Z"})
    multipliers.push_back({{name, dimension::length, "force on the node, master's axes"}, Role::force});
  if (group->in_plane()) multipliers.pop_back();
  const auto rows = static_cast<Eigen::Index>(multipliers.size());
  BlockStore alone;
  const auto block =
      (context.blocks ? *context.blocks : alone)
          .block<NodeLinks>(group->in_plane() ? "rigid, plane" : "rigid", link_layout(group->in_plane(), std::move(multipliers)));
  std::unique_ptr<Element> first;
  for (std::size_t i = 0; i < group->nodes.size(); ++i) {
    auto one = NodeLinks::add(block, context.record.id, {data.master, group->nodes[i]},
                              {group->places[i], NodeLink::Weights::Identity(rows, 3), false, group->small, group->height});
    if (!first)
      first = std::move(one);
    else if (context.more)
      context.more->push_back(std::move(one));
  }
  return first;
}

}  // namespace

ElementType rigid_link_type() {
  deck::Card<RigidLinkData> card("RIGID_LINK", {"LIAISON_RIGIDE"}, "Rigid link: a group of nodes follows a node");
  card.numbered()
      .chapter("Meshes")
      .describe(
          "Every node of the group keeps its place in the axes of the node N, in displacements and rotations of any size (small "
          "where those of the cells are): the "
          "group is rigid. Only translations of the group are linked. Joints, gears and loads act on N. Of nodes of plane cells "
          "the components x and y are linked, and the rotation of N about z turns them.")
      .example("I 7 RIGID_LINK N 100 GROUP \"hub\"")
      .example("I 7 RIGID_LINK N 100 MEMBERS 1 2 3");
  add_link_nodes(card);
  return element_type(card, build);
}

}  // namespace engrane::elements::structural
