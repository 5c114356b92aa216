// SPDX-License-Identifier: BSD-3-Clause
#include "solve/constraints/leaves.hpp"

#include <numeric>
#include <utility>

namespace engrane::solve {

namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// Columns are clearly independent in a leaf when their remainders there are longer than this.
constexpr double clearly = 1e-3;

std::size_t index(Eigen::Index i) { return static_cast<std::size_t>(i); }

}  // namespace

Sparse with_columns_scaled(Sparse a, const Eigen::VectorXd& factor) {
  for (Eigen::Index j = 0; j < a.cols(); ++j)
    for (Sparse::InnerIterator it(a, j); it; ++it) it.valueRef() *= factor[j];
  return a;
}

Eigen::MatrixXd Leaves::block(const Sparse& a, int group, std::span<const int> some) const {
  const int first = group_rows[index(group)];
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(group_rows[index(group) + 1] - first, static_cast<Eigen::Index>(some.size()));
  for (std::size_t j = 0; j < some.size(); ++j)
    for (Sparse::InnerIterator it(a, some[j]); it; ++it)
      if (it.row() >= first && it.row() - first < dense.rows())
        dense(it.row() - first, static_cast<Eigen::Index>(j)) = it.value();
  return dense;
}

Leaves take_leaves(const Sparse& a, std::vector<int> group_rows) {
  Leaves leaves;
  leaves.group_rows = std::move(group_rows);
  if (leaves.group_rows.empty()) {
    leaves.group_rows.resize(index(a.rows()));
    std::iota(leaves.group_rows.begin(), leaves.group_rows.end(), 0);
  }
  leaves.group_rows.push_back(static_cast<int>(a.rows()));
  const std::vector<int>& first_row = leaves.group_rows;
  const std::size_t groups = first_row.size() - 1, n = index(a.cols());
  std::vector<int> group_of(index(a.rows()));
  for (std::size_t g = 0; g < groups; ++g)
    for (int i = first_row[g]; i < first_row[g + 1]; ++i) group_of[index(i)] = static_cast<int>(g);
  // rows ascend in a column, and so do groups
  const auto for_each_group = [&](int j, auto&& use) {
    int last = -1;
    for (Sparse::InnerIterator it(a, j); it; ++it)
      if (const int g = group_of[index(it.row())]; g != last) use(index(last = g));
  };
  std::vector<std::vector<int>> touching(groups);
  for (int j = 0; j < static_cast<int>(n); ++j) for_each_group(j, [&](std::size_t g) { touching[g].push_back(j); });
  std::vector<std::size_t> left(groups);
  std::vector<bool> taken(n, false);
  std::vector<int> ready;
  const auto look_at = [&](std::size_t g) {
    if (left[g] > 0 && left[g] <= index(first_row[g + 1] - first_row[g])) ready.push_back(static_cast<int>(g));
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
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(leaves.block(a, g, mine));
    if (!(qr.matrixR().diagonal().cwiseAbs().minCoeff() > clearly)) continue;
    leaves.groups.push_back(g);
    leaves.columns.insert(leaves.columns.end(), mine.begin(), mine.end());
    leaves.begin.push_back(static_cast<int>(leaves.columns.size()));
    for (const int j : mine) {
      taken[index(j)] = true;
      for_each_group(j, [&](std::size_t other) {
        --left[other];
        look_at(other);
      });
    }
  }
  for (int j = 0; j < static_cast<int>(n); ++j)
    if (!taken[index(j)]) leaves.rest.push_back(j);
  return leaves;
}

}  // namespace engrane::solve
