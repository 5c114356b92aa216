// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/SparseCore>
#include <cstddef>
#include <vector>

#include "solve/constraints/leaves.hpp"

namespace engrane::solve {

/// Determines which columns of a sparse matrix are independent, and which combinations of columns vanish.
///
/// It works in two stages, each at the cost of a sparse solve (docs/decisions/0011). Leaves are removed first: where the
/// columns that touch a group of rows are no more than its rows and clearly independent there, they depend on no others, and
/// the matrix is continued without them. Open chains and bodies on a common carrier vanish completely. The rest, the loops, is
/// factored by the rank-revealing sparse QR of SuiteSparse (SPQR; Davis 2011), of which R is kept.
class ColumnBasis {
 public:
  using Sparse = Eigen::SparseMatrix<double>;
  using Vector = Eigen::VectorXd;

  /// The columns of `a` have length 1, or are empty. A column counts as dependent if its remainder after the others is shorter
  /// than `tolerance`. `groups`: first rows of the groups, ascending from 0; if empty, each row is a group. Throws
  /// std::bad_alloc if R does not fit into memory.
  ColumnBasis(Sparse a, double tolerance, std::vector<int> groups = {});

  Eigen::Index rows() const { return a_.rows(); }
  Eigen::Index columns() const { return a_.cols(); }
  Eigen::Index rank() const { return columns() - static_cast<Eigen::Index>(dependent_.size()); }
  const std::vector<int>& dependent() const { return dependent_; }  ///< ascending

  /// Basis of the vectors with A x = 0: one column for each dependent column, whose own entry is 1.
  const Sparse& null() const { return null_; }

  /// Returns a vector near `wish` with Aᵀy = 0.
  Vector left_null(const Vector& wish) const;
  /// Returns a small vector with (Aᵀy)_i = b_i for all independent columns i.
  Vector solve_transposed(const Vector& b) const;

  /// Number of entries of R, for the columns not taken by leaves: a measure of the cost.
  std::size_t factor_entries() const { return upper_.entry.size() + pivot_.size(); }

 private:
  /// A triangular matrix by columns: the entries of column k are those from begin[k] to begin[k + 1].
  struct Triangle {
    std::vector<int> begin{0}, at;
    std::vector<double> entry;
  };

  void factor(double tolerance);
  /// Returns a y near the given one (the nearest, but for leaves) with (Aᵀy)_i = b_i for the independent columns.
  Vector corrected(Vector y, const Vector& b) const;

  Sparse a_;
  Leaves leaves_;
  std::vector<int> core_;  ///< independent columns outside leaves, in the order of R
  std::vector<int> dependent_;
  Triangle upper_;             ///< their R without its diagonal
  std::vector<double> pivot_;  ///< its diagonal
  Sparse null_;
};

}  // namespace engrane::solve
