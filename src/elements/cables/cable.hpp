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
  int function = 0;  ///< function of time that multiplies the length
};

/// CABLE: elastic catenary between two nodes; resists tension only.
ElementType cable_type();

}  // namespace engrane::elements::cables
