// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>

#include "model/registry.hpp"

namespace engrane {

/// Card of a revolute joint. `HINGE N a b AXIS x y z [AT x y z] [DRIVE ANGLE|SPEED NF f] [K k C c ANGLE0 deg]`
struct HingeData {
  std::array<int, 2> nodes{};
  std::array<double, 3> axis{};
  std::optional<std::array<double, 3>> at;  ///< joint point in the reference configuration; default: where the nodes are
  deck::Tagged drive;                       ///< ANGLE or SPEED
  int function = 0;                         ///< of the drive: radians, or radians per time
  double stiffness = 0;                     ///< on the angle, per radian
  double damping = 0;
  double angle0 = 0;  ///< at which the spring is relaxed, degrees
};

/// HINGE (CHARNIERE): node B turns about an axis held by node A through a point held by both.
ElementType hinge_type();

}  // namespace engrane
