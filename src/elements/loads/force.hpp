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
  std::optional<std::array<double, 3>> direction;  ///< of one node
  double value = 0;                                ///< between two nodes, positive pushes them apart
  int function = 0;                                ///< factor on the value
  bool follow = false;                             ///< the direction turns with the node
  bool fixed = false;                              ///< it does not (default)
  std::optional<std::array<double, 3>> at;         ///< where it acts, reference configuration; with the ground: the ground's end
};

/// FORCE: force between two nodes along their line, or on one node from outside.
ElementType force_type();

}  // namespace engrane::elements::loads
