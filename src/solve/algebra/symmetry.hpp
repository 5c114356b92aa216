// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "solve/algebra/rows.hpp"

namespace engrane::solve {

/// Tells whether a matrix on any number of ranks is symmetric, at the price of a few products with a vector: Ax and Aᵀx agree
/// for one x without pattern. What is smaller than rounding of the largest entry of its row goes unseen; a factorisation that
/// takes the matrix for symmetric then has a backward error of that size, which refinement removes.
class SymmetryTest {
 public:
  explicit SymmetryTest(Mat matrix) : matrix_(matrix), half_(is_half(matrix)) {}
  /// Parts of the largest entry of a row: rounding of a sum of some hundred terms.
  static constexpr double rounding = 1e-12;
  /// Of the matrix as it stands; rows may differ by this `part` of their largest entry. Collective.
  bool symmetric(double part = rounding);
  /// Whether no entry on the diagonal is zero or negative: a positive definite matrix has none. Collective.
  bool positive_diagonal();
  /// Gives back its memory until it is asked again.
  void rest();

 private:
  void prepare();
  Mat matrix_;
  bool half_;  ///< there is nothing to compare
  Owned<Vec> probe_, product_, transposed_, largest_;
};

}  // namespace engrane::solve
