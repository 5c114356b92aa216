// SPDX-License-Identifier: BSD-3-Clause
// Shared wrappers for SuiteSparse's QR factorization.
#pragma once

#include <Eigen/SparseCore>
#include <SuiteSparseQR.hpp>
#include <cstddef>
#include <vector>

namespace engrane {

/// Owns CHOLMOD's settings and workspace.
class Cholmod {
 public:
  Cholmod() {
    cholmod_l_start(&common_);
    common_.print = 0;
  }
  ~Cholmod() { cholmod_l_finish(&common_); }
  Cholmod(const Cholmod&) = delete;
  Cholmod& operator=(const Cholmod&) = delete;
  cholmod_common* get() { return &common_; }

 private:
  cholmod_common common_{};
};

/// A sparse matrix in CHOLMOD's compressed-column format, built column by column.
class CompressedColumns {
 public:
  explicit CompressedColumns(std::size_t rows) { view_.nrow = rows; }
  CompressedColumns(const CompressedColumns&) = delete;
  CompressedColumns& operator=(const CompressedColumns&) = delete;

  /// Appends an entry to the current column; rows must ascend.
  void put(Eigen::Index row, double value) {
    at_.push_back(row);
    entry_.push_back(value);
  }
  void end_column() { begin_.push_back(static_cast<SuiteSparse_long>(at_.size())); }

  bool empty() const { return at_.empty(); }
  cholmod_sparse* get() {
    view_.ncol = begin_.size() - 1;
    view_.nzmax = at_.size();
    view_.p = begin_.data();
    view_.i = at_.data();
    view_.x = entry_.data();
    view_.itype = CHOLMOD_LONG;
    view_.xtype = CHOLMOD_REAL;
    view_.dtype = CHOLMOD_DOUBLE;
    view_.sorted = view_.packed = 1;
    return &view_;
  }

 private:
  std::vector<SuiteSparse_long> begin_{0}, at_;
  std::vector<double> entry_;
  cholmod_sparse view_{};
};

/// Numerical rank of the compressed matrix `a`. A column counts as dependent if its norm, orthogonalised against the other
/// columns, is below `tolerance`.
Eigen::Index rank_of(const Eigen::SparseMatrix<double>& a, double tolerance);

}  // namespace engrane
