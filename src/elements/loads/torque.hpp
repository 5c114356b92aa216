// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "model/registry.hpp"

namespace engrane::elements::loads {

/// Card of an applied moment. `TORQUE N [a] b AXIS x y z V value [NF f] [FOLLOW|FIXED]`
struct TorqueData {
  std::vector<int> nodes;  ///< one or two; +V acts on the last, −V on the first of two
  std::array<double, 3> axis{};
  double value = 0;
  int function = 0;     ///< function of time that multiplies the value
  bool follow = false;  ///< the axis rotates with the first node; the default for two nodes
  bool fixed = false;   ///< the axis is fixed in space; the default for one node
};

/// TORQUE (COUPLE): moment between two nodes, or between the ground and one node.
ElementType torque_type();

}  // namespace engrane::elements::loads
