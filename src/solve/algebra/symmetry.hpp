// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "assembly/petsc.hpp"

namespace engrane::solve {

/// Tells whether a matrix on any number of ranks is symmetric, at the price of a few products with a vector: Ax and Aᵀx agree
/// for one x without pattern. What is smaller than rounding of the largest entry of its row goes unseen; a factorisation that
/// takes the matrix for symmetric then has a backward error of that size, which refinement removes.
class SymmetryTest {
 public:
  explicit SymmetryTest(Mat matrix) : matrix_(matrix) {}
  /// Of the matrix as it stands. Collective.
  bool symmetric();
  /// Whether no entry on the diagonal is zero or negative: a positive definite matrix has none. Collective.
  bool positive_diagonal();

 private:
  void prepare();
  Mat matrix_;
  Owned<Vec> probe_, product_, transposed_, largest_;
};

}  // namespace engrane::solve
