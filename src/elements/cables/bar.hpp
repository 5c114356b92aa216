// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>

#include "model/registry.hpp"

namespace engrane::elements::cables {

/// Card of a bar. `BAR N a b EA ea [M m] [LENGTH l | TENSION t] [LOG] [ONLY_TENSION w] [DAMPING t]`
struct BarData {
  std::array<int, 2> nodes{};
  double stiffness = 0;  ///< EA
  double mass = 0;       ///< per unit length
  std::optional<double> length, tension;
  bool logarithmic = false;
  std::optional<double> width;  ///< strain range over which it becomes slack
  double damping = 0;           ///< time constant
};

/// BAR (BARRE): resists changes of its length only, at any strain, with mass and prestress.
ElementType bar_type();

}  // namespace engrane::elements::cables
