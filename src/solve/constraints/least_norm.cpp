// SPDX-License-Identifier: BSD-3-Clause
#include "solve/constraints/least_norm.hpp"

#include <new>
#include <utility>

#include "math/sparse_qr.hpp"

namespace engrane::solve {

using Sparse = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;
using Dense = Eigen::MatrixXd;

struct RowSpace::Factors {
  explicit Factors(CompressedColumns& a, double tolerance)
      : qr(SuiteSparseQR_factorize<double>(SPQR_ORDERING_DEFAULT, tolerance, a.get(), cholmod.get())) {
    if (!qr) throw std::bad_alloc();
  }
  ~Factors() { SuiteSparseQR_free(&qr, cholmod.get()); }
  Factors(const Factors&) = delete;
  Factors& operator=(const Factors&) = delete;

  /// QᵀX or QX, by `method`.
  Dense times(int method, Dense x) {
    cholmod_dense right{};
    right.nrow = right.d = static_cast<std::size_t>(x.rows());
    right.ncol = static_cast<std::size_t>(x.cols());
    right.nzmax = right.nrow * right.ncol;
    right.x = x.data();
    right.xtype = CHOLMOD_REAL;
    right.dtype = CHOLMOD_DOUBLE;
    cholmod_dense* product = SuiteSparseQR_qmult<double>(method, qr, &right, cholmod.get());
    if (!product) throw std::bad_alloc();
    x = Eigen::Map<const Dense>(static_cast<const double*>(product->x), x.rows(), x.cols());
    cholmod_l_free_dense(&product, cholmod.get());
    return x;
  }

  Cholmod cholmod;
  SuiteSparseQR_factorization<double>* qr;
};

RowSpace::RowSpace(const Sparse& a, double tolerance, std::vector<int> groups) {
  Vector length(a.cols());
  for (Eigen::Index j = 0; j < a.cols(); ++j) length[j] = a.rows() > 0 ? a.col(j).norm() : 0.0;
  Sparse unit = with_columns_scaled(a, (length.array() > 0).select(length.cwiseInverse(), 1.0));
  unit.makeCompressed();
  leaves_ = take_leaves(unit, std::move(groups));

  if (leaves_.rest.empty()) return;

  // transposed: one column for each row of `a` that the remaining columns touch
  Sparse rest(a.rows(), static_cast<Eigen::Index>(leaves_.rest.size()));
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t j = 0; j < leaves_.rest.size(); ++j)
    for (Sparse::InnerIterator it(a, leaves_.rest[j]); it; ++it)
      entries.emplace_back(static_cast<int>(it.row()), static_cast<int>(j), it.value());
  rest.setFromTriplets(entries.begin(), entries.end());
  using ByRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  const ByRows by_rows = rest;
  CompressedColumns transposed(leaves_.rest.size());
  for (Eigen::Index i = 0; i < by_rows.rows(); ++i) {
    const double size = by_rows.row(i).norm();
    if (size == 0) continue;
    for (ByRows::InnerIterator it(by_rows, i); it; ++it) transposed.put(it.col(), it.value() / size);
    transposed.end_column();
  }
  if (!transposed.empty()) factors_ = std::make_shared<Factors>(transposed, tolerance);
}

Eigen::Index RowSpace::rank() const {
  return static_cast<Eigen::Index>(leaves_.columns.size()) + (factors_ ? static_cast<Eigen::Index>(factors_->qr->rank) : 0);
}

double RowSpace::left_out() const { return factors_ ? factors_->cholmod.get()->SPQR_norm_E_fro : 0; }

Dense RowSpace::part(const Dense& x) const {
  Dense result = x;
  const auto size = static_cast<Eigen::Index>(leaves_.rest.size());
  Dense rest = Dense::Zero(size, x.cols());
  if (factors_) {
    for (Eigen::Index j = 0; j < size; ++j) rest.row(j) = x.row(leaves_.rest[static_cast<std::size_t>(j)]);
    rest = factors_->times(SPQR_QTX, std::move(rest));
    rest.bottomRows(size - static_cast<Eigen::Index>(factors_->qr->rank)).setZero();
    rest = factors_->times(SPQR_QX, std::move(rest));
  }
  for (Eigen::Index j = 0; j < size; ++j) result.row(leaves_.rest[static_cast<std::size_t>(j)]) = rest.row(j);
  return result;
}

}  // namespace engrane::solve
