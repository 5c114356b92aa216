// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "elements/common/spring_law.hpp"

namespace engrane::elements::springs {

/// Card of a spring. `SPRING N a b [K k | LAW TABLE f | LAW POLY k1 k2 k3 | LAW USER f] [C c | CLAW f] [L0 l] [AT x y z]` along
/// the line of two nodes, or `SPRING N a b [K kx ky kz] [C cx cy cz]` in the three global directions.
struct SpringData : SpringLawData {
  std::array<int, 2> nodes{};
  std::vector<double> stiffness;            ///< one value or three
  std::vector<double> damping;              ///< one value or three
  std::optional<double> length;             ///< natural length; default: that of the reference configuration
  std::optional<std::array<double, 3>> at;  ///< end on the ground; default: the origin
};

/// SPRING (RESSORT): spring and damper between two nodes.
ElementType spring_type();

}  // namespace engrane::elements::springs
