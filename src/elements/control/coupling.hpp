// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>

#include "model/registry.hpp"

namespace engrane::elements::control {

/// Card of a coupling. `COUPLING JOINTS i j RATIO r [OFFSET o] [FIRST name] [SECOND name] [K k C c]`
struct CouplingData {
  std::array<int, 2> joints{};               ///< element ids
  double ratio = 1;                          ///< of the second coordinate to the first, with angles in radians
  double offset = 0;                         ///< of the second coordinate, degrees for an angle
  std::string first, second;                 ///< names of the coordinates; empty: the joint's first
  std::optional<double> stiffness, damping;  ///< on the second coordinate; if neither is given, the relation is exact
};

/// COUPLING (COUPLAGE): couples the coordinates of two joints by a ratio.
ElementType coupling_type();

}  // namespace engrane::elements::control
