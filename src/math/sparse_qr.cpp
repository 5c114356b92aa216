// SPDX-License-Identifier: BSD-3-Clause
#include "math/sparse_qr.hpp"

#include <new>

namespace engrane {

Eigen::Index rank_of(const Eigen::SparseMatrix<double>& a, double tolerance) {
  if (a.nonZeros() == 0) return 0;
  CompressedColumns columns(static_cast<std::size_t>(a.rows()));
  for (Eigen::Index j = 0; j < a.cols(); ++j) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(a, j); it; ++it) columns.put(it.row(), it.value());
    columns.end_column();
  }
  Cholmod cholmod;
  const auto rank = SuiteSparseQR<double>(SPQR_ORDERING_DEFAULT, tolerance, 0, columns.get(), nullptr, nullptr, cholmod.get());
  if (rank < 0) throw std::bad_alloc();
  return static_cast<Eigen::Index>(rank);
}

}  // namespace engrane
