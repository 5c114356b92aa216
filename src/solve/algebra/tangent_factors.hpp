// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "solve/algebra/symmetry.hpp"

namespace engrane::solve {

/// Factors of the tangent at an equilibrium, by MUMPS on any number of ranks, and what they say about its stability. Nothing is
/// kept from one matrix to the next, so that a restart gives the same digits.
class TangentFactors {
 public:
  /// Takes ownership of the matrix.
  explicit TangentFactors(Mat matrix) : symmetry_(matrix) { *matrix_.out() = matrix; }

  Mat matrix() const { return matrix_; }
  /// Factors the matrix as it stands; false if it is singular to the last digit. Collective.
  bool factor();
  void solve(Vec right, Vec solution) { check_petsc(MatSolve(factors_, right, solution)); }

  /// Number of negative eigenvalues of a symmetric matrix (Sylvester's law of inertia). For other matrices 1 if the determinant
  /// is negative, else 0.
  int negative() const { return negative_; }
  /// Whether the matrix was treated as symmetric, which it is but for the moments that Newton's iteration leaves unbalanced.
  bool symmetric() const { return is_symmetric_; }

 private:
  Owned<Mat> matrix_;
  SymmetryTest symmetry_;
  Owned<Mat> factors_;
  bool is_symmetric_ = false;
  int negative_ = 0;
};

}  // namespace engrane::solve
