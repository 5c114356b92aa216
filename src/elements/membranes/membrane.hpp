// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "elements/membranes/membrane_law.hpp"
#include "model/registry.hpp"

namespace engrane::elements::membranes {

/// Card of a membrane. `MEMBRANE N n1 … MAT m THICK t [TENSION s] [WRINKLING [SLACK e]] [PRESSURE p [NF f]]`
struct MembraneData {
  std::vector<int> nodes;  ///< corners, then mid-side nodes
  int material = 0;
  double thickness = 0;
  double tension = 0;  ///< isotropic prestress in the reference configuration
  bool wrinkling = false;
  double slack = slack_stiffness;  ///< fraction of the stiffness that remains where it wrinkles or is slack
  double pressure = 0;
  int function = 0;
};

/// MEMBRANE: membrane in space for large strains, without bending stiffness, with a follower pressure.
ElementType membrane_type();

}  // namespace engrane::elements::membranes
