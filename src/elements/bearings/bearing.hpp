// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "model/registry.hpp"

namespace engrane::elements::bearings {

/// Card of a bearing. `BEARING N a b AXIS x y z` with `K … [C …] [SPEED …]`, `BALLS n D d DM d MAT m …` or
/// `ROLLERS n D d DM d L l MAT m …`
struct BearingData {
  std::array<int, 2> nodes{};
  std::array<double, 3> axis{};
  std::optional<std::array<double, 3>> axis_2, at;
  std::vector<double> stiffness, damping, speeds;
  std::optional<int> balls, rollers;
  std::optional<double> diameter, pitch_diameter, length;
  std::optional<double> inner_conformity, outer_conformity;
  std::optional<double> contact_angle;  ///< degrees
  std::optional<double> clearance, preload;
  std::optional<int> material;
  bool straight = false;
  std::optional<int> slices;
};

/// BEARING (ROULEMENT, PALIER): elastic support of a shaft in its housing that leaves its spin free.
ElementType bearing_type();

}  // namespace engrane::elements::bearings
