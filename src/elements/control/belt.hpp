// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>

#include "model/registry.hpp"

namespace engrane::elements::control {

/// Card of a belt. `BELT N a b AXIS x y z R r1 r2 [CROSSED] [K k | EA ea] [C c] [PRELOAD t] [MU mu]`
struct BeltData {
  std::array<int, 2> nodes{};
  std::array<double, 3> axis{};
  std::array<double, 2> radii{};
  bool crossed = false;
  std::optional<double> stiffness;  ///< stiffness of one free span
  std::optional<double> rigidity;   ///< EA; a span's stiffness is EA over its length
  double damping = 0;               ///< damping of one free span at its preload
  double preload = 0;               ///< tension of both spans in the reference configuration
  std::optional<double> friction;   ///< between belt and pulleys
  bool sticks = false;              ///< the belt slips when friction is exceeded
};

/// BELT (COURROIE): two pulleys and a belt.
ElementType belt_type();

}  // namespace engrane::elements::control
