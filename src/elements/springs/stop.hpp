// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>

#include "elements/common/stop_range.hpp"

namespace engrane::elements::springs {

/// Card of a stop. `STOP N a b (nothing | AXIS x y z | NORMAL x y z [ON x y z] [AT x y z]) [MIN s] [MAX s] K k [EXP n] [DAMP ..]`
struct StopData : StopRangeData {  // limits of an angle are in degrees
  std::array<int, 2> nodes{};
  std::optional<std::array<double, 3>> axis;    ///< limits the angle about this axis
  std::optional<std::array<double, 3>> normal;  ///< limits the height above a plane with this normal
  std::optional<std::array<double, 3>> on;      ///< a point of the plane; default: node A
  std::optional<std::array<double, 3>> at;      ///< the point kept above the plane, or the ground end of a distance
};

/// STOP (BUTEE): keeps a distance, an angle or the height above a plane within limits by unilateral contact.
ElementType stop_type();

}  // namespace engrane::elements::springs
