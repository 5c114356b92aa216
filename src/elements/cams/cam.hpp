// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "model/registry.hpp"

namespace engrane::elements::cams {

/// Card of a cam: `CAM N a b AXIS x y z [CENTER x y z] profile FOLLOWER .. [AT x y z] [DIRECTION x y z | PIVOT x y z] [K k ..]`
struct CamData {
  std::array<int, 2> nodes{};
  std::array<double, 3> axis{};
  std::optional<std::array<double, 3>> center, zero;
  std::vector<double> table, polar;                 ///< x y pairs; degrees and radii
  std::vector<double> motion;                       ///< width of a segment in degrees, lift at its end, ...
  std::vector<std::string> laws{"CYCLOIDAL"};       ///< one for all segments, or one each
  std::optional<double> base;                       ///< base circle of a motion
  double phase = 0;                                 ///< degrees
  deck::Tagged side;                                ///< OUTSIDE or INSIDE
  deck::Tagged follower;                            ///< KNIFE, ROLLER r, FLAT
  std::optional<std::array<double, 3>> at, normal;  ///< the follower's point and the normal of its face
  std::optional<std::array<double, 3>> direction, pivot;
  std::optional<double> stiffness;  ///< given: the contact only pushes
  double exponent = 1;
  deck::Tagged damping;
  deck::Tagged friction;
  std::optional<double> friction_width;
};

/// CAM (CAME): a knife edge, roller or flat face on body B in contact with the profile of a cam on body A.
ElementType cam_type();

}  // namespace engrane::elements::cams
