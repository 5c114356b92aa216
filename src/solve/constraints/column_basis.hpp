// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/SparseCore>
#include <cstddef>
#include <vector>

#include "solve/constraints/leaves.hpp"

namespace engrane::solve {

/// Which columns of a sparse matrix are independent, and the combinations of them that vanish.
///
/// Two things in turn, each of the cost of a sparse solve (docs/decisions/0011). Leaves go first: where the columns that touch
/// a group of rows are no more than its rows and clearly independent there, they depend on nothing else, and the matrix goes on
/// without them; open chains and bodies on a common carrier vanish to nothing. What is left, the loops, goes to the
/// rank-revealing sparse QR of SuiteSparse (SPQR; Davis 2011), of which R is kept.
class ColumnBasis {
 public:
  using Sparse = Eigen::SparseMatrix<double>;
  using Vector = Eigen::VectorXd;

  /// Columns of `a` are of length 1, or empty; one counts as dependent where its remainder after the others is shorter than
  /// `tolerance`. `groups`: first rows of the groups, ascending from 0; each row is one when there are none. Throws
  /// std::bad_alloc when R does not fit into memory.
  ColumnBasis(Sparse a, double tolerance, std::vector<int> groups = {});

  Eigen::Index rows() const { return a_.rows(); }
  Eigen::Index columns() const { return a_.cols(); }
  Eigen::Index rank() const { return columns() - static_cast<Eigen::Index>(dependent_.size()); }
  const std::vector<int>& dependent() const { return dependent_; }  ///< ascending

  /// Basis of the vectors with A x = 0: a column for each dependent one, in which that one counts 1.
  const Sparse& null() const { return null_; }

  /// A vector near `wish` with Aᵀy = 0.
  Vector left_null(const Vector& wish) const;
  /// A small vector with (Aᵀy)_i = b_i for all independent columns i.
  Vector solve_transposed(const Vector& b) const;

  /// Columns that leaves took, and entries of R for the others: what it cost.
  std::size_t leaf_columns() const { return leaves_.columns.size(); }
  std::size_t factor_entries() const { return upper_.entry.size() + pivot_.size(); }

 private:
  /// A triangle by columns: the entries of number k stand from begin[k] to begin[k + 1].
  struct Triangle {
    std::vector<int> begin{0}, at;
    std::vector<double> entry;
  };

  void factor(double tolerance);
  /// A y near the given one, the nearest but for leaves, that has (Aᵀy)_i = b_i for the independent columns.
  Vector corrected(Vector y, const Vector& b) const;

  Sparse a_;
  Leaves leaves_;
  std::vector<int> core_;  ///< independent columns of the others, in the order of R
  std::vector<int> dependent_;
  Triangle upper_;             ///< R of them without its diagonal
  std::vector<double> pivot_;  ///< its diagonal
  Sparse null_;
};

}  // namespace engrane::solve
