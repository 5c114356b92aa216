// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "assembly/petsc.hpp"

namespace engrane::solve {

/// A number between 0.5 and 1.5 for each index: fractional parts of multiples of the golden ratio. No two numbers, sums or
/// differences are alike, and none depends on the ranks.
double probe_value(std::size_t place);
void fill_probe(Vec vector);

}  // namespace engrane::solve
