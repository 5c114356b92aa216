// SPDX-License-Identifier: BSD-3-Clause
#include "solve/constraints/column_basis.hpp"

#include <Eigen/Dense>
#include <SuiteSparseQR.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <new>
#include <numeric>
#include <queue>
#include <utility>

namespace engrane::solve {

namespace {

/// Entries below this in columns of length 1 are rounding; following them would fill what is sparse.
constexpr double rounding = 1e-13;
/// Columns are clearly independent in a leaf when their remainders there are longer than this.
constexpr double clearly = 1e-3;

std::size_t index(Eigen::Index i) { return static_cast<std::size_t>(i); }

/// CHOLMOD's settings and memory.
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

/// A sparse vector in the elimination by an upper triangle: its places are taken from the last, new ones come before.
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

  /// The last place and its value, which is final.
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

ColumnBasis::ColumnBasis(Sparse a, double tolerance, std::vector<int> groups) : a_(std::move(a)), groups_(std::move(groups)) {
  a_.makeCompressed();
  if (groups_.empty()) {
    groups_.resize(index(rows()));
    std::iota(groups_.begin(), groups_.end(), 0);
  }
  groups_.push_back(static_cast<int>(rows()));
  take_leaves();
  factor(tolerance);
}

Eigen::MatrixXd ColumnBasis::block(int group, const int* first, const int* end) const {
  const int begin = groups_[index(group)];
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(groups_[index(group) + 1] - begin, end - first);
  for (const int* j = first; j != end; ++j)
    for (Sparse::InnerIterator it(a_, *j); it; ++it)
      if (it.row() >= begin && it.row() - begin < dense.rows()) dense(it.row() - begin, j - first) = it.value();
  return dense;
}

void ColumnBasis::take_leaves() {
  const std::size_t groups = groups_.size() - 1, n = index(columns());
  std::vector<int> group_of(index(rows()));
  for (std::size_t g = 0; g < groups; ++g)
    for (int i = groups_[g]; i < groups_[g + 1]; ++i) group_of[index(i)] = static_cast<int>(g);
  // rows ascend in a column, and so do groups
  const auto for_each_group = [&](int j, auto&& use) {
    int last = -1;
    for (Sparse::InnerIterator it(a_, j); it; ++it)
      if (const int g = group_of[index(it.row())]; g != last) use(index(last = g));
  };
  std::vector<std::vector<int>> touching(groups);
  for (int j = 0; j < static_cast<int>(n); ++j) for_each_group(j, [&](std::size_t g) { touching[g].push_back(j); });
  std::vector<std::size_t> left(groups);
  std::vector<bool> taken(n, false);
  std::vector<int> ready;
  const auto look_at = [&](std::size_t g) {
    if (left[g] > 0 && left[g] <= index(groups_[g + 1] - groups_[g])) ready.push_back(static_cast<int>(g));
  };
  for (std::size_t g = 0; g < groups; ++g) {
    left[g] = touching[g].size();
    look_at(g);
  }
  std::vector<int> mine;
  while (!ready.empty()) {
    const int g = ready.back();
    ready.pop_back();
    mine.clear();
    for (const int j : touching[index(g)])
      if (!taken[index(j)]) mine.push_back(j);
    if (mine.empty()) continue;
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(block(g, mine.data(), mine.data() + mine.size()));
    if (!(qr.matrixR().diagonal().cwiseAbs().minCoeff() > clearly)) continue;
    leaf_groups_.push_back(g);
    leaf_columns_.insert(leaf_columns_.end(), mine.begin(), mine.end());
    leaf_begin_.push_back(static_cast<int>(leaf_columns_.size()));
    for (const int j : mine) {
      taken[index(j)] = true;
      for_each_group(j, [&](std::size_t other) {
        --left[other];
        look_at(other);
      });
    }
  }
  for (int j = 0; j < static_cast<int>(n); ++j)
    if (!taken[index(j)]) core_.push_back(j);
}

void ColumnBasis::factor(double tolerance) {
  const std::vector<int> all = std::exchange(core_, {});
  const auto n = static_cast<int>(all.size());
  using Long = SuiteSparse_long;
  std::vector<Long> begin{0}, at;
  std::vector<double> entry;
  for (const int j : all) {
    for (Sparse::InnerIterator it(a_, j); it; ++it) {
      at.push_back(it.row());
      entry.push_back(it.value());
    }
    begin.push_back(static_cast<Long>(at.size()));
  }
  Cholmod cholmod;
  cholmod_sparse core{};
  core.nrow = index(rows());
  core.ncol = index(n);
  core.nzmax = at.size();
  core.p = begin.data();
  core.i = at.data();
  core.x = entry.data();
  core.itype = CHOLMOD_LONG;
  core.xtype = CHOLMOD_REAL;
  core.dtype = CHOLMOD_DOUBLE;
  core.sorted = core.packed = 1;
  cholmod_sparse* factor = nullptr;
  Long* order = nullptr;
  // orders by degree cost as much, but their null vectors run on through many loops
  if (!at.empty()) SuiteSparseQR<double>(SPQR_ORDERING_METIS, tolerance, 0, &core, &factor, &order, cholmod.get());
  const auto free_factor = [&](cholmod_sparse* r) { cholmod_l_free_sparse(&r, cholmod.get()); };
  const auto free_order = [&](Long* e) { cholmod_l_free(index(n), sizeof(Long), e, cholmod.get()); };
  const std::unique_ptr<cholmod_sparse, decltype(free_factor)> r(factor, free_factor);
  const std::unique_ptr<Long, decltype(free_order)> permutation(order, free_order);
  if (!at.empty() && !r) throw std::bad_alloc();

  // R is a staircase: a column is independent where it goes one row farther than those before it
  std::vector<int> places;  // in the order of R, of the dependent columns
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
  // y += A (RᵀR)⁻¹ (b − Aᵀy) over the columns of the core; the second pass takes back the rounding of the first
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
  // no other column than those of a leaf touches its rows but those of leaves taken before
  for (std::size_t leaf = leaf_groups_.size(); leaf-- > 0;) {
    const int* first = leaf_columns_.data() + leaf_begin_[leaf];
    const int* end = leaf_columns_.data() + leaf_begin_[leaf + 1];
    Vector open(end - first);
    for (const int* j = first; j != end; ++j) open[j - first] = short_of(*j);
    const Eigen::MatrixXd rows_of = block(leaf_groups_[leaf], first, end).transpose();
    y.segment(groups_[index(leaf_groups_[leaf])], rows_of.cols()) += rows_of.completeOrthogonalDecomposition().solve(open);
  }
  return y;
}

ColumnBasis::Vector ColumnBasis::left_null(const Vector& wish) const { return corrected(wish, Vector::Zero(columns())); }

ColumnBasis::Vector ColumnBasis::solve_transposed(const Vector& b) const { return corrected(Vector::Zero(rows()), b); }

}  // namespace engrane::solve
