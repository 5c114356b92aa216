// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "solve/algebra/rows.hpp"

namespace engrane::solve {

/// Tests whether a matrix on any number of ranks is symmetric, at the cost of a few products with a vector: Ax and Aᵀx must
/// agree for one unstructured x. Differences below the rounding of the largest entry of a row remain undetected. A
/// factorisation that treats the matrix as symmetric then has a backward error of that size, which refinement removes.
class SymmetryTest {
 public:
  explicit SymmetryTest(Mat matrix) : matrix_(matrix), half_(is_half(matrix)) {}
  /// Fraction of the largest entry of a row: rounding of a sum of some hundred terms. A row with more entries may differ by
  /// more, in proportion; the rows of its columns, which are short, show an asymmetry all the same.
  static constexpr double rounding = 1e-12;
  /// Tests the matrix as it stands; rows may differ by the fraction `part` of their largest entry. Collective.
  bool symmetric(double part = rounding);
  /// Whether all diagonal entries are positive, as in every positive definite matrix. Collective.
  bool positive_diagonal();
  /// Frees its memory until the next test.
  void rest();

 private:
  void prepare();
  Mat matrix_;
  bool half_;  ///< only half is stored: there is nothing to compare
  Owned<Vec> probe_, product_, transposed_, largest_;
};

}  // namespace engrane::solve
