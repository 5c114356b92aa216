// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "model/registry.hpp"

namespace engrane::elements::loads {

/// Card of an applied force. `FORCE N a b V value [NF f] [AT x y z]` between two nodes, or
/// `FORCE N b DIR x y z V value [NF f] [FOLLOW|FIXED] [AT x y z]` on one.
struct ForceData {
  std::vector<int> nodes;                          ///< one or two
  std::optional<std::array<double, 3>> direction;  ///< for one node only
  double value = 0;                                ///< between two nodes, positive pushes them apart
  int function = 0;                                ///< function of time that multiplies the value
  bool follow = false;                             ///< the direction rotates with the node
  bool fixed = false;                              ///< the direction is fixed in space (default)
  std::optional<std::array<double, 3>> at;         ///< point of action, reference configuration; between nodes: ground end
};

/// FORCE: force between two nodes along their line, or external force on one node.
ElementType force_type();

}  // namespace engrane::elements::loads
