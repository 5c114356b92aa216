// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "elements/membranes/membrane_law.hpp"
#include "model/registry.hpp"

namespace engrane::elements::membranes {

/// Card of a membrane. `MEMBRANE N n1 … MAT m THICK t [TENSION s] [WRINKLING [SLACK e]] [PRESSURE p [NF f]]`
struct MembraneData {
  std::vector<int> nodes;  ///< corners, then middles of sides
  int material = 0;
  double thickness = 0;
  double tension = 0;  ///< stress in every direction, in the reference configuration
  bool wrinkling = false;
  double slack = slack_stiffness;  ///< part of the stiffness that is left where it wrinkles
  double pressure = 0;
  int function = 0;
};

/// MEMBRANE: a thin skin in space that resists strain in its surface only, at any strain, with pressure that follows it.
ElementType membrane_type();

}  // namespace engrane::elements::membranes
