// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Dense>
#include <Eigen/SparseCore>
#include <memory>
#include <vector>

#include "solve/constraints/leaves.hpp"

namespace engrane::solve {

/// Row space of a sparse matrix `a`, at the cost of one sparse QR of the columns outside leaves (take_leaves), dependent or
/// not. The projection of x onto it is the shortest x' with a x' = a x: Q₁Q₁ᵀx, where Q₁ holds the columns of Q up to the rank,
/// from a QR of aᵀ (Golub and Van Loan, Matrix Computations, 5.5). No null vectors are formed, which may extend through the
/// whole model.
class RowSpace {
 public:
  /// A row counts as dependent if its remainder after the others is shorter than `tolerance` times its length. `groups`: as for
  /// take_leaves. Throws std::bad_alloc if Q does not fit into memory.
  RowSpace(const Eigen::SparseMatrix<double>& a, double tolerance, std::vector<int> groups = {});

  Eigen::Index rank() const;
  /// Norm of the remainders of the rows that count as dependent, for rows of length 1: how exactly the space contains the rows.
  /// It is rounding over the smallest remainder of the other rows, since rows are not chosen by size. a(x − part(x)) is as
  /// large, times the lengths of rows and x; the error of part(x) is that over the smallest singular value.
  double left_out() const;
  /// Projects each column of `x` onto the space.
  Eigen::MatrixXd part(const Eigen::MatrixXd& x) const;

 private:
  struct Factors;

  Leaves leaves_;
  std::shared_ptr<Factors> factors_;  ///< null if leaves take all columns, or the others are empty
};

}  // namespace engrane::solve
