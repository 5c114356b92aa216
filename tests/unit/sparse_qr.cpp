// SPDX-License-Identifier: BSD-3-Clause
#include "math/sparse_qr.hpp"

#include <gtest/gtest.h>

namespace engrane {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

Sparse sparse(const Eigen::MatrixXd& dense) {
  Sparse a = dense.sparseView();
  a.makeCompressed();
  return a;
}

TEST(SparseQr, RankIsTheNumberOfIndependentColumns) {
  Eigen::MatrixXd a(4, 3);
  a << 1, 0, 1,  //
      0, 1, 1,   //
      0, 0, 0,   //
      2, 0, 2;
  EXPECT_EQ(rank_of(sparse(a), 1e-9), 2);
  a(2, 2) = 1e-6;
  EXPECT_EQ(rank_of(sparse(a), 1e-9), 3);
  a(2, 2) = 1e-12;
  EXPECT_EQ(rank_of(sparse(a), 1e-9), 2);
}

TEST(SparseQr, OfNothingAndOfFewerRowsThanColumns) {
  EXPECT_EQ(rank_of(sparse(Eigen::MatrixXd::Zero(3, 2)), 1e-9), 0);
  EXPECT_EQ(rank_of(Sparse(0, 4), 1e-9), 0);
  EXPECT_EQ(rank_of(sparse(Eigen::MatrixXd::Ones(1, 5)), 1e-9), 1);
}

/// Differences of neighbours in a ring: all but one are independent.
TEST(SparseQr, OfALongRing) {
  constexpr int n = 20000;
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < n; ++j) {
    entries.emplace_back(j, j, 1);
    entries.emplace_back((j + 1) % n, j, -1);
  }
  Sparse ring(n, n);
  ring.setFromTriplets(entries.begin(), entries.end());
  EXPECT_EQ(rank_of(ring, 1e-9), n - 1);
}

}  // namespace
}  // namespace engrane
