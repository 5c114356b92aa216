// SPDX-License-Identifier: BSD-3-Clause
#include "solve/constraints/column_basis.hpp"

#include <umfpack.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <memory>
#include <new>
#include <queue>
#include <utility>

namespace engrane::solve {

namespace {

/// Entries below this in columns of length 1 are rounding; following them would fill what is sparse.
constexpr double rounding = 1e-15;
/// A dependent column returns to the basis only when its remainder is this many times the tolerance, or the two could take turns.
constexpr double clearly = 10;

std::size_t index(Eigen::Index i) { return static_cast<std::size_t>(i); }

void check_umfpack(int status) {
  if (status < 0) throw std::bad_alloc();  // of its errors only that of memory can come from a well-formed matrix
}

/// A sparse vector under elimination: its entries are taken in the order of their places, new ones come behind.
template <class Order>
class Elimination {
 public:
  explicit Elimination(std::size_t size) : value_(size, 0.0), seen_(size, false) {}

  void add(int place, double value) {
    value_[static_cast<std::size_t>(place)] += value;
    if (seen_[static_cast<std::size_t>(place)]) return;
    seen_[static_cast<std::size_t>(place)] = true;
    places_.push(place);
  }

  bool empty() const { return places_.empty(); }

  /// The next place and its value, which is final.
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
  std::priority_queue<int, std::vector<int>, Order> places_;
};

}  // namespace

ColumnBasis::ColumnBasis(const Sparse& a, double tolerance, const std::vector<int>& dependent)
    : rows_(a.rows()), columns_(a.cols()) {
  for (int j = 0; j < static_cast<int>(columns_); ++j) {
    const bool left_out = a.innerVector(j).nonZeros() == 0 || std::binary_search(dependent.begin(), dependent.end(), j);
    (left_out ? dependent_ : independent_).push_back(j);
  }
  constexpr int most_rounds = 4;
  for (int round = 0; round < most_rounds; ++round) {
    drop_small_pivots(a, tolerance);
    const Sparse remainder = eliminate_dependent(a);
    // a pivot of rounding took a row away from others, which only therefore seemed dependent
    std::vector<int> open;
    for (Eigen::Index j = 0; j < remainder.cols(); ++j)
      for (Sparse::InnerIterator it(remainder, j); it; ++it)
        if (std::abs(it.value()) > clearly * tolerance) {
          open.push_back(static_cast<int>(j));
          break;
        }
    if (open.empty()) return;
    Sparse part(remainder.rows(), static_cast<Eigen::Index>(open.size()));
    for (std::size_t j = 0; j < open.size(); ++j) part.col(static_cast<Eigen::Index>(j)) = remainder.col(open[j]);
    const ColumnBasis among(part, clearly * tolerance);
    if (among.rank() == 0) return;
    for (const int j : among.independent()) independent_.push_back(dependent_[index(open[index(j)])]);
    std::sort(independent_.begin(), independent_.end());
    std::vector<int> left;
    std::set_difference(dependent_.begin(), dependent_.end(), independent_.begin(), independent_.end(), std::back_inserter(left));
    dependent_ = std::move(left);
  }
  drop_small_pivots(a, tolerance);
  eliminate_dependent(a);
}

void ColumnBasis::drop_small_pivots(const Sparse& a, double tolerance) {
  for (;;) {
    factor(a);
    std::vector<int> kept;
    for (std::size_t k = 0; k < pivot_.size(); ++k)
      if (std::abs(pivot_[k]) >= tolerance) kept.push_back(column_[k]);
    if (kept.size() == independent_.size()) return;
    std::sort(kept.begin(), kept.end());
    std::set_difference(independent_.begin(), independent_.end(), kept.begin(), kept.end(), std::back_inserter(dependent_));
    std::sort(dependent_.begin(), dependent_.end());
    independent_ = std::move(kept);
  }
}

void ColumnBasis::factor(const Sparse& a) {
  const auto m = static_cast<int>(rows_), n = static_cast<int>(independent_.size());
  const int pivots = std::min(m, n);
  lower_ = upper_ = {};
  pivot_.clear();
  column_.clear();
  row_.resize(index(rows_));
  for (int i = 0; i < m; ++i) row_[index(i)] = i;
  lower_.begin.assign(index(m) + 1, 0);
  upper_.begin.assign(index(n) + 1, 0);
  if (pivots == 0) return;

  std::vector<int> begin{0}, at;
  std::vector<double> entry;
  for (const int j : independent_) {
    for (Sparse::InnerIterator it(a, j); it; ++it) {
      at.push_back(static_cast<int>(it.row()));
      entry.push_back(it.value());
    }
    begin.push_back(static_cast<int>(at.size()));
  }
  std::array<double, UMFPACK_CONTROL> control{};
  umfpack_di_defaults(control.data());
  control[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_UNSYMMETRIC;
  control[UMFPACK_SCALE] = UMFPACK_SCALE_NONE;  // sizes have a meaning here
  control[UMFPACK_SINGLETONS] = 0;              // they would be pivots however small
  using Symbolic = std::unique_ptr<void, decltype([](void* p) { umfpack_di_free_symbolic(&p); })>;
  using Numeric = std::unique_ptr<void, decltype([](void* p) { umfpack_di_free_numeric(&p); })>;
  void* made = nullptr;
  check_umfpack(umfpack_di_symbolic(m, n, begin.data(), at.data(), entry.data(), &made, control.data(), nullptr));
  const Symbolic symbolic(made);
  check_umfpack(umfpack_di_numeric(begin.data(), at.data(), entry.data(), symbolic.get(), &made, control.data(), nullptr));
  const Numeric numeric(made);

  int entries_l = 0, entries_u = 0, found_m = 0, found_n = 0, on_diagonal = 0;
  check_umfpack(umfpack_di_get_lunz(&entries_l, &entries_u, &found_m, &found_n, &on_diagonal, numeric.get()));
  const auto size = [](Triangle& t, int entries) {
    t.at.resize(index(entries));
    t.entry.resize(index(entries));
  };
  size(lower_, entries_l);
  size(upper_, entries_u);
  std::vector<int> order(index(n));
  std::vector<double> pivot(index(pivots));
  int reciprocal = 0;
  check_umfpack(umfpack_di_get_numeric(lower_.begin.data(), lower_.at.data(), lower_.entry.data(), upper_.begin.data(),
                                       upper_.at.data(), upper_.entry.data(), row_.data(), order.data(), pivot.data(),
                                       &reciprocal, nullptr, numeric.get()));
  pivot_ = std::move(pivot);
  for (const int j : order) column_.push_back(independent_[index(j)]);
  // the diagonals are known
  for (Triangle* t : {&lower_, &upper_}) {
    int kept = 0;
    for (std::size_t k = 0; k + 1 < t->begin.size(); ++k) {
      const int first = std::exchange(t->begin[k], kept);
      for (int e = first; e < t->begin[k + 1]; ++e) {
        if (t->at[index(e)] == static_cast<int>(k)) continue;
        t->at[index(kept)] = t->at[index(e)];
        t->entry[index(kept++)] = t->entry[index(e)];
      }
    }
    t->begin.back() = kept;
    size(*t, kept);
  }
}

ColumnBasis::Sparse ColumnBasis::eliminate_dependent(const Sparse& a) {
  const auto pivots = pivot_.size();
  const auto m = index(rows_);
  null_ = Sparse(columns_, static_cast<Eigen::Index>(dependent_.size()));
  Sparse remainder(rows_, null_.cols());
  if (dependent_.empty()) return remainder;
  // L by columns
  Triangle columns{std::vector<int>(pivots + 1, 0), std::vector<int>(lower_.at.size()), std::vector<double>(lower_.at.size())};
  for (const int j : lower_.at) ++columns.begin[index(j) + 1];
  for (std::size_t k = 0; k < pivots; ++k) columns.begin[k + 1] += columns.begin[k];
  std::vector<int> next(columns.begin.begin(), columns.begin.end());
  for (std::size_t i = 0; i < m; ++i)
    for (int e = lower_.begin[i]; e < lower_.begin[i + 1]; ++e) {
      const int to = next[index(lower_.at[index(e)])]++;
      columns.at[index(to)] = static_cast<int>(i);
      columns.entry[index(to)] = lower_.entry[index(e)];
    }
  std::vector<int> place(m);
  for (std::size_t k = 0; k < m; ++k) place[index(row_[k])] = static_cast<int>(k);

  Elimination<std::greater<>> forward(m);
  Elimination<std::less<>> backward(pivots);
  std::vector<Eigen::Triplet<double>> combinations, remainders;
  for (std::size_t d = 0; d < dependent_.size(); ++d) {
    const auto column = static_cast<int>(d);
    for (Sparse::InnerIterator it(a, dependent_[d]); it; ++it) forward.add(place[index(it.row())], it.value());
    while (!forward.empty()) {
      const auto [k, value] = forward.take();
      if (std::abs(value) <= rounding) continue;
      if (index(k) >= pivots) {
        remainders.emplace_back(k, column, value);
        continue;
      }
      backward.add(k, value);
      for (int e = columns.begin[index(k)]; e < columns.begin[index(k) + 1]; ++e)
        forward.add(columns.at[index(e)], -value * columns.entry[index(e)]);
    }
    combinations.emplace_back(dependent_[d], column, 1.0);
    while (!backward.empty()) {
      const auto [k, value] = backward.take();
      const double part = value / pivot_[index(k)];
      if (std::abs(value) <= rounding) continue;
      combinations.emplace_back(column_[index(k)], column, -part);
      for (int e = upper_.begin[index(k)]; e < upper_.begin[index(k) + 1]; ++e)
        backward.add(upper_.at[index(e)], -part * upper_.entry[index(e)]);
    }
  }
  null_.setFromTriplets(combinations.begin(), combinations.end());
  remainder.setFromTriplets(remainders.begin(), remainders.end());
  return remainder;
}

ColumnBasis::Vector ColumnBasis::back_through_lower(Vector y) const {
  for (std::size_t k = row_.size(); k-- > 0;)
    for (int e = lower_.begin[k]; e < lower_.begin[k + 1]; ++e)
      y[lower_.at[index(e)]] -= lower_.entry[index(e)] * y[static_cast<Eigen::Index>(k)];
  Vector result(rows_);
  for (Eigen::Index k = 0; k < rows_; ++k) result[row_[index(k)]] = y[k];
  return result;
}

ColumnBasis::Vector ColumnBasis::left_null(const Vector& wish) const {
  Vector y(rows_);
  for (Eigen::Index k = 0; k < rows_; ++k) y[k] = k < rank() ? 0.0 : wish[row_[index(k)]];
  return back_through_lower(std::move(y));
}

ColumnBasis::Vector ColumnBasis::solve_transposed(const Vector& b) const {
  Vector y = Vector::Zero(rows_);
  for (std::size_t k = 0; k < pivot_.size(); ++k) {
    double sum = b[column_[k]];
    for (int e = upper_.begin[k]; e < upper_.begin[k + 1]; ++e) sum -= upper_.entry[index(e)] * y[upper_.at[index(e)]];
    y[static_cast<Eigen::Index>(k)] = sum / pivot_[k];
  }
  return back_through_lower(std::move(y));
}

ColumnBasis::Vector ColumnBasis::solve(const Vector& b) const {
  Vector y(rows_), x(columns_);
  for (std::size_t k = 0; k < row_.size(); ++k) {
    double sum = b[row_[k]];
    for (int e = lower_.begin[k]; e < lower_.begin[k + 1]; ++e) sum -= lower_.entry[index(e)] * y[lower_.at[index(e)]];
    y[static_cast<Eigen::Index>(k)] = sum;
  }
  for (std::size_t k = pivot_.size(); k-- > 0;) {
    const double part = y[static_cast<Eigen::Index>(k)] / pivot_[k];
    x[column_[k]] = part;
    for (int e = upper_.begin[k]; e < upper_.begin[k + 1]; ++e) y[upper_.at[index(e)]] -= part * upper_.entry[index(e)];
  }
  return x;
}

}  // namespace engrane::solve
