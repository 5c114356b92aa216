// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/SparseCore>
#include <cstddef>
#include <vector>

namespace engrane::solve {

/// Which columns of a sparse matrix are independent, and the combinations of them that vanish.
///
/// Gaussian elimination P A_I Q = L U of an independent set I of columns, by UMFPACK with threshold pivoting (Davis 2004):
/// a column whose remainder after all others is below the tolerance leaves the set. Costs what a sparse solve costs, and null
/// vectors are as sparse as they are by nature (docs/decisions/0011).
class ColumnBasis {
 public:
  using Sparse = Eigen::SparseMatrix<double>;
  using Vector = Eigen::VectorXd;

  ColumnBasis() = default;
  /// Columns of `a` are of length 1, or empty; `tolerance` is compared with the entries of their remainders. `dependent`:
  /// columns that are believed to be so (ascending): where that is true one factorisation is enough. Throws std::bad_alloc
  /// when the factors do not fit into memory.
  ColumnBasis(const Sparse& a, double tolerance, const std::vector<int>& dependent = {});

  Eigen::Index rows() const { return rows_; }
  Eigen::Index columns() const { return columns_; }
  Eigen::Index rank() const { return static_cast<Eigen::Index>(independent_.size()); }
  const std::vector<int>& independent() const { return independent_; }  ///< ascending
  const std::vector<int>& dependent() const { return dependent_; }      ///< ascending

  /// Basis of the vectors with A x = 0: a column for each dependent one, in which that one counts 1.
  const Sparse& null() const { return null_; }

  /// A vector with Aᵀy = 0 that is `wish` in the rows without pivot.
  Vector left_null(const Vector& wish) const;
  /// A vector with (Aᵀy)_i = b_i for all independent columns i, zero in the rows without pivot.
  Vector solve_transposed(const Vector& b) const;
  /// The solution of A x = b, of a square matrix of full rank.
  Vector solve(const Vector& b) const;

  /// Entries of both factors: what it cost.
  std::size_t factor_entries() const { return lower_.entry.size() + upper_.entry.size(); }

 private:
  /// A triangle, or a trapezium, by rows or columns: those of number k stand from begin[k] to begin[k + 1].
  struct Triangle {
    std::vector<int> begin, at;
    std::vector<double> entry;
  };

  void factor(const Sparse& a);
  /// Factors until all pivots are above the tolerance; columns with smaller ones become dependent.
  void drop_small_pivots(const Sparse& a, double tolerance);
  /// Finds null(); returns the remainders of the dependent columns over the rows without pivot.
  Sparse eliminate_dependent(const Sparse& a);
  /// y in place: the entries without pivot are given, the others hold the right-hand side of Lᵀy = t.
  Vector back_through_lower(Vector y) const;

  Eigen::Index rows_ = 0, columns_ = 0;
  std::vector<int> independent_, dependent_;
  Sparse null_;
  Triangle lower_;  ///< L by rows of the pivoted order, without the ones of its diagonal
  Triangle upper_;  ///< U by columns of the pivoted order, without its diagonal
  std::vector<double> pivot_;
  std::vector<int> row_;     ///< of A, at a place of the pivoted order
  std::vector<int> column_;  ///< of A, at a place of the pivoted order
};

}  // namespace engrane::solve
