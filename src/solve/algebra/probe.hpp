// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "assembly/petsc.hpp"

namespace engrane::solve {

/// A number between 0.5 and 1.5 for each index: fractional parts of multiples of the golden ratio. No two numbers, sums or
/// differences are alike, and none depends on the ranks.
double probe_value(std::size_t place);
void fill_probe(Vec vector);

/// Stiffness of a motion x beside the diagonal D of the matrix K: |xᵀKx| / xᵀDx, with `load` = K x; infinite if D is zero there.
/// With fill_probe() for the load, x is all but the softest motion. Collective.
double relative_stiffness(Mat matrix, Vec motion, Vec load);

}  // namespace engrane::solve
