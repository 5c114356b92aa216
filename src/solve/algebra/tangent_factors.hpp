// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "solve/algebra/symmetry.hpp"

namespace engrane::solve {

/// Factors of the tangent of an equilibrium, by MUMPS on any number of ranks, and what they tell of its stability. Nothing is
/// kept from one matrix to the next, so that a restart finds the same digits.
class TangentFactors {
 public:
  /// Takes the matrix over.
  explicit TangentFactors(Mat matrix) : symmetry_(matrix) { *matrix_.out() = matrix; }

  Mat matrix() const { return matrix_; }
  /// Of the matrix as it stands; false where it is singular to the last digit. Collective.
  bool factor();
  void solve(Vec right, Vec solution) { check_petsc(MatSolve(factors_, right, solution)); }

  /// Of a symmetric matrix the number of its negative eigenvalues (Sylvester's law of inertia). Of others 1 where the determinant
  /// is negative, else 0.
  int negative() const { return negative_; }
  /// Whether the matrix was taken for symmetric: what Newton's iteration leaves of moments makes it so but for that part.
  bool symmetric() const { return is_symmetric_; }

 private:
  Owned<Mat> matrix_;
  SymmetryTest symmetry_;
  Owned<Mat> factors_;
  bool is_symmetric_ = false;
  int negative_ = 0;
};

}  // namespace engrane::solve
