// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "assembly/petsc.hpp"

namespace engrane::solve {

/// Rows with more than max(16, 10 √n) entries (Amestoy, Davis and Duff, Algorithm 837: AMD, ACM TOMS 30, 2004), as those of a
/// node that a large group follows.
struct DenseRows {
  double work = 0;   ///< that they cause in an analysis: the sum of the squares of their numbers of entries
  double share = 0;  ///< number of entries of the longest, relative to that of all columns
};

/// The dense rows of all ranks. Collective.
DenseRows dense_rows(Mat matrix);

/// Makes factors of MUMPS and analyses the matrix for them, in an order of elimination that fits its dense rows
/// (docs/decisions/0031-links-to-meshes.md). `room` is the workspace above the estimate, per cent (ICNTL(14)); it is larger where
/// many pivots will not be where the analysis expects them. `set_options` gives new factors all other options.
void analyse_for_mumps(Mat matrix, bool symmetric, int room, Owned<Mat>& factors, const std::function<void(Mat)>& set_options);

}  // namespace engrane::solve
