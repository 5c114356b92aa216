// SPDX-License-Identifier: BSD-3-Clause
#include "model/sweep.hpp"

namespace engrane {

std::size_t plan_sweep(const Layout& layout, std::span<int> translation, std::span<int> rotation, std::span<int> directions,
                       std::vector<std::size_t>& lane_slots) {
  for (std::size_t i = 0; i < layout.nodes.size(); ++i) {
    const bool in_plane = layout.needs[i] == NodeNeed::in_plane;
    directions[i] = in_plane ? 2 : 3;
    translation[i] = layout.node_slot(i, in_plane ? NodeNeed::in_plane : NodeNeed::translation);
    rotation[i] = layout.node_slot(i, NodeNeed::rotation);
    if (layout.nodes[i] == 0) continue;
    for (int c = 0; c < directions[i] && translation[i] >= 0; ++c)
      lane_slots.push_back(static_cast<std::size_t>(translation[i] + c));
    for (int c = 0; c < 3 && rotation[i] >= 0; ++c) lane_slots.push_back(static_cast<std::size_t>(rotation[i] + c));
  }
  assert(layout.scalars.size() <= 8 && layout.multipliers.size() <= 16);
  const auto slots = static_cast<std::size_t>(layout.slots());
  for (auto slot = static_cast<std::size_t>(layout.node_slots()); slot < slots; ++slot) lane_slots.push_back(slot);
  return slots;
}

}  // namespace engrane
