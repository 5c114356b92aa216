// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>

#include "model/registry.hpp"

namespace engrane::elements::cables {

/// Card of a cable. `CABLE N a b EA ea [M m] [LENGTH l [NF f] | TENSION t]`
struct CableData {
  std::array<int, 2> nodes{};
  double stiffness = 0;  ///< EA
  double mass = 0;       ///< per unstretched length
  std::optional<double> length, tension;
  int function = 0;  ///< of time, a factor of the length
};

/// CABLE: hangs between two nodes as an elastic catenary, and resists tension only.
ElementType cable_type();

}  // namespace engrane::elements::cables
