// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "model/registry.hpp"

namespace engrane::elements::beams {

/// Card of a load along a line. `LINE_LOAD N n1 n2 … V qx qy qz [NF f] [FOLLOW] [LINEAR]`
struct LineLoadData {
  std::vector<int> nodes;
  std::array<double, 3> load = {0, 0, 0};  ///< force per unit length at rest
  int function = 0;
  bool follow = false;  ///< turns with the nodes
  bool linear = false;  ///< pieces of two nodes
};

/// LINE_LOAD (CHARGE_LINEIQUE): force per unit length along a line of nodes.
ElementType line_load_type();

}  // namespace engrane::elements::beams
