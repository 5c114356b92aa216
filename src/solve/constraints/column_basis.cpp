// SPDX-License-Identifier: BSD-3-Clause
#include "solve/constraints/column_basis.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <memory>
#include <new>
#include <numeric>
#include <queue>
#include <utility>

#include "math/sparse_qr.hpp"

namespace engrane::solve {

namespace {

std::size_t index(Eigen::Index i) { return static_cast<std::size_t>(i); }

/// Entries below this in columns of length 1 are rounding; eliminating with them would cause fill-in.
constexpr double rounding = 1e-13;

/// A sparse vector during elimination by an upper triangle: entries are taken from the last on, and new ones come before it.
class Elimination {
 public:
  explicit Elimination(std::size_t size) : value_(size, 0.0), seen_(size, false) {}

  void add(int place, double value) {
    const auto at = static_cast<std::size_t>(place);
    value_[at] += value;
    if (seen_[at]) return;
    seen_[at] = true;
    places_.push(place);
  }

  bool empty() const { return places_.empty(); }

  /// Takes the last place and its value, which is final.
  std::pair<int, double> take() {
    const int place = places_.top();
    places_.pop();
    const auto at = static_cast<std::size_t>(place);
    seen_[at] = false;
    return {place, std::exchange(value_[at], 0.0)};
  }

 private:
  std::vector<double> value_;
  std::vector<bool> seen_;
  std::priority_queue<int> places_;
};

}  // namespace

ColumnBasis::ColumnBasis(Sparse a, double tolerance, std::vector<int> groups)
    : a_(std::move(a)), leaves_(take_leaves(a_, std::move(groups))) {
  a_.makeCompressed();
  factor(tolerance);
}

void ColumnBasis::factor(double tolerance) {
  const std::vector<int>& all = leaves_.rest;
  const auto n = static_cast<int>(all.size());
  using Long = SuiteSparse_long;
  CompressedColumns core(index(rows()));
  for (const int j : all) {
    for (Sparse::InnerIterator it(a_, j); it; ++it) core.put(it.row(), it.value());
    core.end_column();
  }
  Cholmod cholmod;
  cholmod_sparse* factor = nullptr;
  Long* order = nullptr;
  // minimum-degree orders cost as much, but their null vectors extend through many loops
  if (!core.empty()) SuiteSparseQR<double>(SPQR_ORDERING_METIS, tolerance, 0, core.get(), &factor, &order, cholmod.get());
  const auto free_factor = [&](cholmod_sparse* r) { cholmod_l_free_sparse(&r, cholmod.get()); };
  const auto free_order = [&](Long* e) { cholmod_l_free(index(n), sizeof(Long), e, cholmod.get()); };
  const std::unique_ptr<cholmod_sparse, decltype(free_factor)> r(factor, free_factor);
  const std::unique_ptr<Long, decltype(free_order)> permutation(order, free_order);
  if (!core.empty() && !r) throw std::bad_alloc();

  // R is a staircase: a column is independent if it reaches one row farther than those before it
  std::vector<int> places;  // of the dependent columns, in the order of R
  const auto* r_begin = r ? static_cast<const Long*>(r->p) : nullptr;
  const auto* r_at = r ? static_cast<const Long*>(r->i) : nullptr;
  const auto* r_entry = r ? static_cast<const double*>(r->x) : nullptr;
  for (int k = 0; k < n; ++k) {
    const int column = all[index(permutation ? permutation.get()[k] : k)];
    const auto step = static_cast<Long>(core_.size());
    double pivot = 0;
    if (r)
      for (Long e = r_begin[k]; e < r_begin[k + 1]; ++e)
        if (r_at[e] == step) pivot = r_entry[e];
    if (pivot == 0) {
      places.push_back(k);
      dependent_.push_back(column);
      continue;
    }
    for (Long e = r_begin[k]; e < r_begin[k + 1]; ++e) {
      if (r_at[e] == step) continue;
      upper_.at.push_back(static_cast<int>(r_at[e]));
      upper_.entry.push_back(r_entry[e]);
    }
    upper_.begin.push_back(static_cast<int>(upper_.at.size()));
    pivot_.push_back(pivot);
    core_.push_back(column);
  }

  std::vector<std::size_t> ascending(dependent_.size());
  std::iota(ascending.begin(), ascending.end(), 0);
  std::sort(ascending.begin(), ascending.end(), [&](std::size_t i, std::size_t j) { return dependent_[i] < dependent_[j]; });
  std::vector<Eigen::Triplet<double>> combinations;
  Elimination x(core_.size());
  for (std::size_t d = 0; d < ascending.size(); ++d) {
    const auto column = static_cast<int>(d);
    const std::size_t which = ascending[d];
    combinations.emplace_back(dependent_[which], column, 1.0);
    const int k = places[which];
    if (r)
      for (Long e = r_begin[k]; e < r_begin[k + 1]; ++e) x.add(static_cast<int>(r_at[e]), r_entry[e]);
    while (!x.empty()) {
      const auto [place, value] = x.take();
      if (std::abs(value) <= rounding) continue;
      const double part = value / pivot_[index(place)];
      combinations.emplace_back(core_[index(place)], column, -part);
      for (int e = upper_.begin[index(place)]; e < upper_.begin[index(place) + 1]; ++e)
        x.add(upper_.at[index(e)], -part * upper_.entry[index(e)]);
    }
  }
  std::sort(dependent_.begin(), dependent_.end());
  null_.resize(columns(), static_cast<Eigen::Index>(dependent_.size()));
  null_.setFromTriplets(combinations.begin(), combinations.end());
}

ColumnBasis::Vector ColumnBasis::corrected(Vector y, const Vector& b) const {
  const auto short_of = [&](int column) { return b[column] - a_.col(column).dot(y); };
  // y += A (RᵀR)⁻¹ (b − Aᵀy) over the columns of the core; the second pass removes the rounding error of the first
  for (int pass = 0; pass < 2; ++pass) {
    Vector x(static_cast<Eigen::Index>(core_.size()));
    for (std::size_t k = 0; k < core_.size(); ++k) {
      double sum = short_of(core_[k]);
      for (int e = upper_.begin[k]; e < upper_.begin[k + 1]; ++e) sum -= upper_.entry[index(e)] * x[upper_.at[index(e)]];
      x[static_cast<Eigen::Index>(k)] = sum / pivot_[k];
    }
    for (std::size_t k = core_.size(); k-- > 0;) {
      const double part = x[static_cast<Eigen::Index>(k)] /= pivot_[k];
      for (int e = upper_.begin[k]; e < upper_.begin[k + 1]; ++e) x[upper_.at[index(e)]] -= part * upper_.entry[index(e)];
    }
    for (std::size_t k = 0; k < core_.size(); ++k) y += x[static_cast<Eigen::Index>(k)] * a_.col(core_[k]);
  }
  // only its own columns and those of leaves taken before touch the rows of a leaf
  for (std::size_t leaf = leaves_.groups.size(); leaf-- > 0;) {
    const std::span<const int> columns = leaves_.of(leaf);
    Vector open(static_cast<Eigen::Index>(columns.size()));
    for (std::size_t j = 0; j < columns.size(); ++j) open[static_cast<Eigen::Index>(j)] = short_of(columns[j]);
    const Eigen::MatrixXd rows_of = leaves_.block(a_, leaves_.groups[leaf], columns).transpose();
    y.segment(leaves_.first_row(leaf), rows_of.cols()) += rows_of.completeOrthogonalDecomposition().solve(open);
  }
  return y;
}

ColumnBasis::Vector ColumnBasis::left_null(const Vector& wish) const { return corrected(wish, Vector::Zero(columns())); }

ColumnBasis::Vector ColumnBasis::solve_transposed(const Vector& b) const { return corrected(Vector::Zero(rows()), b); }

}  // namespace engrane::solve
