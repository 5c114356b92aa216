// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "model/registry.hpp"

namespace engrane::elements::joints {

/// Card of a linear relation. `.LIA I 1 NOEUD 3 4 C 1 1 A 2. -1. [V v] [NF f]`: Σ A u equals V times the function.
struct LinearRelationData {
  std::vector<int> nodes, components;  ///< one entry per term
  std::vector<double> coefficients;
  double value = 0;
  int function = 0;
};

/// .LIA: linear relation between displacements and rotations of nodes.
ElementType linear_relation_type();

}  // namespace engrane::elements::joints
