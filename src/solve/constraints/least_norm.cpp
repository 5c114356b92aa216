// SPDX-License-Identifier: BSD-3-Clause
#include "solve/constraints/least_norm.hpp"

#include <memory>
#include <new>
#include <utility>

#include "solve/constraints/leaves.hpp"
#include "solve/constraints/sparse_qr.hpp"

namespace engrane::solve {

using Sparse = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;
using Dense = Eigen::MatrixXd;

Dense shortest_equivalent(const Sparse& a, const Dense& x, double tolerance, std::vector<int> groups) {
  Vector length(a.cols());
  for (Eigen::Index j = 0; j < a.cols(); ++j) length[j] = a.col(j).norm();
  Sparse unit = with_columns_scaled(a, (length.array() > 0).select(length.cwiseInverse(), 1.0));
  unit.makeCompressed();
  const Leaves leaves = take_leaves(unit, std::move(groups));

  // transposed: a column for each row of `a` that the remaining columns touch
  Sparse rest(a.rows(), static_cast<Eigen::Index>(leaves.rest.size()));
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t j = 0; j < leaves.rest.size(); ++j)
    for (Sparse::InnerIterator it(a, leaves.rest[j]); it; ++it) entries.emplace_back(it.row(), static_cast<int>(j), it.value());
  rest.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SparseMatrix<double, Eigen::RowMajor> by_rows = rest;
  CompressedColumns transposed(leaves.rest.size());
  for (Eigen::Index i = 0; i < by_rows.rows(); ++i) {
    const double size = by_rows.row(i).norm();
    if (size == 0) continue;
    for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(by_rows, i); it; ++it)
      transposed.put(it.col(), it.value() / size);
    transposed.end_column();
  }
  Dense shortest = x;
  if (leaves.rest.empty()) return shortest;
  for (const int j : leaves.rest) shortest.row(j).setZero();
  if (transposed.empty()) return shortest;

  Cholmod cholmod;
  const auto free_factors = [&](SuiteSparseQR_factorization<double>* f) { SuiteSparseQR_free(&f, cholmod.get()); };
  const std::unique_ptr<SuiteSparseQR_factorization<double>, decltype(free_factors)> factors(
      SuiteSparseQR_factorize<double>(SPQR_ORDERING_DEFAULT, tolerance, transposed.get(), cholmod.get()), free_factors);
  if (!factors) throw std::bad_alloc();
  const auto free_dense = [&](cholmod_dense* d) { cholmod_l_free_dense(&d, cholmod.get()); };
  using Result = std::unique_ptr<cholmod_dense, decltype(free_dense)>;
  const auto size = static_cast<Eigen::Index>(leaves.rest.size());
  Dense part(size, x.cols());
  for (Eigen::Index j = 0; j < size; ++j) part.row(j) = x.row(leaves.rest[static_cast<std::size_t>(j)]);
  cholmod_dense right{};
  right.nrow = right.d = leaves.rest.size();
  right.ncol = static_cast<std::size_t>(x.cols());
  right.nzmax = right.nrow * right.ncol;
  right.x = part.data();
  right.xtype = CHOLMOD_REAL;
  right.dtype = CHOLMOD_DOUBLE;
  const Result inside(SuiteSparseQR_qmult<double>(SPQR_QTX, factors.get(), &right, cholmod.get()), free_dense);
  if (!inside) throw std::bad_alloc();
  Eigen::Map<Dense>(static_cast<double*>(inside->x), size, x.cols()).bottomRows(size - factors->rank).setZero();
  const Result back(SuiteSparseQR_qmult<double>(SPQR_QX, factors.get(), inside.get(), cholmod.get()), free_dense);
  if (!back) throw std::bad_alloc();
  const Eigen::Map<const Dense> equivalent(static_cast<const double*>(back->x), size, x.cols());
  for (Eigen::Index j = 0; j < size; ++j) shortest.row(leaves.rest[static_cast<std::size_t>(j)]) = equivalent.row(j);
  return shortest;
}

}  // namespace engrane::solve
