// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "model/registry.hpp"

namespace engrane::elements::control {

/// Card of a sensor. `SENSOR N a b DISTANCE [AT x y z]`, `SENSOR N a b ANGLE AXIS x y z`,
/// `SENSOR N a b DISPLACEMENT AXIS x y z`. Without a the sensor measures from the ground.
struct SensorData {
  std::vector<int> nodes;  ///< one or two
  deck::Tagged kind;       ///< DISTANCE, ANGLE or DISPLACEMENT
  std::optional<std::array<double, 3>> axis;
  std::optional<std::array<double, 3>> at;  ///< end on the ground of a distance
};

/// SENSOR (CAPTEUR): observes a distance, an angle or a displacement. It exerts no forces and adds no unknowns.
ElementType sensor_type();

}  // namespace engrane::elements::control
