// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Dense>
#include <Eigen/SparseCore>
#include <span>
#include <vector>

namespace engrane::solve {

/// Multiplies each column of the matrix by its factor; in place, since a product with a diagonal matrix grows entry by entry.
Eigen::SparseMatrix<double> with_columns_scaled(Eigen::SparseMatrix<double> a, const Eigen::VectorXd& factor);

/// Columns of a sparse matrix that clearly depend on no others, found without a factorisation. Where the columns that touch a
/// group of rows are no more than its rows and independent there, they form a leaf, and the matrix is continued without them.
struct Leaves {
  std::vector<int> group_rows;         ///< first row of each group, then the number of rows
  std::vector<int> groups;             ///< group of each leaf, in the order of removal
  std::vector<int> begin{0}, columns;  ///< of leaf k: columns from begin[k] to begin[k + 1]
  std::vector<int> rest;               ///< columns of no leaf, ascending

  std::span<const int> of(std::size_t leaf) const { return {columns.data() + begin[leaf], columns.data() + begin[leaf + 1]}; }
  Eigen::Index first_row(std::size_t leaf) const { return group_rows[static_cast<std::size_t>(groups[leaf])]; }
  /// Returns the block of the rows of a group and some columns, as a dense matrix.
  Eigen::MatrixXd block(const Eigen::SparseMatrix<double>& a, int group, std::span<const int> columns) const;
};

/// `a`: compressed, its columns of length 1, or empty. `group_rows`: first rows of the groups, ascending from 0; if empty, each
/// row is a group.
Leaves take_leaves(const Eigen::SparseMatrix<double>& a, std::vector<int> group_rows);

}  // namespace engrane::solve
