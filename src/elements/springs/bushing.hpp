// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "model/registry.hpp"

namespace engrane::elements::springs {

/// Card of a bush. `BUSHING N a b K k1..k6 [C c1..c6] [AT x y z] [AXIS x y z [AXIS2 x y z]]`
struct BushingData {
  std::array<int, 2> nodes{};
  std::vector<double> stiffness;  ///< 6: the diagonal; 21: the upper triangle by rows
  std::vector<double> damping;    ///< likewise
  std::optional<std::array<double, 3>> at;
  std::optional<std::array<double, 3>> axis;    ///< first axis; default: global x
  std::optional<std::array<double, 3>> axis_2;  ///< across it, towards the second axis; default: any perpendicular
};

/// BUSHING (SILENTBLOC): 6×6 stiffness and damping between two nodes, in axes fixed to the first.
ElementType bushing_type();

}  // namespace engrane::elements::springs
