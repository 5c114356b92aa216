// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>

#include "elements/common/stop_range.hpp"

namespace engrane::elements::springs {

/// Card of a stop. `STOP N a b (nothing | AXIS x y z | NORMAL x y z [ON x y z] [AT x y z]) [MIN s] [MAX s] K k [EXP n] [DAMP ..]`
struct StopData : StopRangeData {  // an angle's limits in degrees
  std::array<int, 2> nodes{};
  std::optional<std::array<double, 3>> axis;    ///< the coordinate is an angle about it
  std::optional<std::array<double, 3>> normal;  ///< the coordinate is a distance from a plane
  std::optional<std::array<double, 3>> on;      ///< a point of the plane; default: node A
  std::optional<std::array<double, 3>> at;      ///< the point held off the plane, or the ground's end of a distance
};

/// STOP (BUTEE): holds a distance, an angle or the height above a plane within limits, by a contact that only pushes.
ElementType stop_type();

}  // namespace engrane::elements::springs
