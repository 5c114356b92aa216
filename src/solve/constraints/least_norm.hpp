// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Dense>
#include <Eigen/SparseCore>
#include <memory>
#include <vector>

#include "solve/constraints/leaves.hpp"

namespace engrane::solve {

/// The space of the rows of a sparse matrix `a`, at the cost of one sparse QR of the columns that no leaf takes (take_leaves),
/// whatever their dependence. The part of x in it is the shortest x' with a x' = a x: Q₁Q₁ᵀx, with the columns of Q up to the
/// rank, of a QR of aᵀ (Golub and Van Loan, Matrix Computations, 5.5). No null vectors are formed, which may run through the
/// whole model.
class RowSpace {
 public:
  /// Rows that have a remainder shorter than `tolerance` of their length after the others count as dependent. `groups`: as
  /// for take_leaves. Throws std::bad_alloc when Q does not fit into memory.
  RowSpace(const Eigen::SparseMatrix<double>& a, double tolerance, std::vector<int> groups = {});

  Eigen::Index rank() const;
  /// The remainders of the rows that count as dependent, of rows of length 1, as one length: how exactly the space holds the
  /// rows. Rounding over the smallest remainder of the others, since these are taken as they come: a(x − part(x)) is as large
  /// times the lengths of rows and x, and the error of part(x) that over the smallest singular value.
  double left_out() const;
  /// The part of each column of `x` that lies in the space.
  Eigen::MatrixXd part(const Eigen::MatrixXd& x) const;

 private:
  struct Factors;

  Leaves leaves_;
  std::shared_ptr<Factors> factors_;  ///< none where leaves take all columns, or the others are empty
};

}  // namespace engrane::solve
