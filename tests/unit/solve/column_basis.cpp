// SPDX-License-Identifier: BSD-3-Clause
// Independent columns and null vectors of sparse matrices, against singular values, and what they cost as matrices grow.
#include "solve/constraints/column_basis.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <random>

#include "solve/constraints/least_norm.hpp"

namespace engrane::solve {
namespace {

using Dense = Eigen::MatrixXd;
using Sparse = ColumnBasis::Sparse;
using Vector = ColumnBasis::Vector;

class Random {
 public:
  explicit Random(unsigned seed) : generator_(seed) {}
  int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(generator_); }
  double value() { return std::uniform_real_distribution<double>(-1, 1)(generator_); }
  void shuffle(Eigen::VectorXi& v) { std::shuffle(v.begin(), v.end(), generator_); }

 private:
  std::mt19937 generator_;
};

Sparse normalized(Dense a) {
  for (Eigen::Index j = 0; j < a.cols(); ++j)
    if (a.col(j).norm() > 0) a.col(j).normalize();
  return a.sparseView();
}

/// Few entries in each column, the last columns combinations of others, then all in disorder; whole numbers every third time.
Sparse planted(Random& random, int seed) {
  const int rows = 2 + random.below(60), columns = 1 + random.below(60), planted = random.below(8);
  Dense a = Dense::Zero(rows, columns + planted);
  for (int j = 0; j < columns; ++j)
    for (int k = random.below(4); k >= 0; --k)
      a(random.below(rows), j) = seed % 3 == 0 ? 1 - 2 * random.below(2) : random.value();
  for (int j = 0; j < planted; ++j)
    for (int k = random.below(5); k >= 0; --k) a.col(columns + j) += random.value() * a.col(random.below(columns));
  Eigen::VectorXi order = Eigen::VectorXi::LinSpaced(a.cols(), 0, static_cast<int>(a.cols()) - 1);
  random.shuffle(order);
  return normalized(a * Eigen::PermutationMatrix<Eigen::Dynamic>(order));
}

TEST(ColumnBasis, RankNullVectorsAndMotionsOfRandomMatrices) {
  Random random(3);
  int deficient = 0;
  for (int seed = 0; seed < 300; ++seed) {
    const Sparse a = planted(random, seed);
    std::vector<int> groups;  // of one to six rows
    for (int row = 0; row < a.rows(); row += 1 + random.below(6)) groups.push_back(row);
    const ColumnBasis basis(a, 1e-9, groups);
    const Vector sizes = Eigen::JacobiSVD<Dense>(Dense(a)).singularValues();
    ASSERT_EQ(basis.rank(), (sizes.array() > 1e-9).count()) << "matrix " << seed;
    ASSERT_EQ(basis.null().cols(), a.cols() - basis.rank());
    deficient += basis.null().cols() > 0;
    for (Eigen::Index j = 0; j < basis.null().cols(); ++j) {
      const Vector x = basis.null().col(j);
      EXPECT_EQ(x[basis.dependent()[static_cast<std::size_t>(j)]], 1);
      EXPECT_LT((a * x).norm(), 1e-10 * x.norm());
    }
    EXPECT_LT((a.transpose() * basis.left_null(Vector::Random(a.rows()))).norm(), 1e-9);
    const Vector b = Vector::Random(a.cols()), y = basis.solve_transposed(b);
    for (Eigen::Index j = 0; j < a.cols(); ++j)
      if (!std::binary_search(basis.dependent().begin(), basis.dependent().end(), j)) {
        EXPECT_LT(std::abs(a.col(j).dot(y) - b[j]), 1e-10 * (1 + y.norm()));
      }
  }
  EXPECT_GT(deficient, 100) << "else this judges little";
}

TEST(RowSpace, IsThatOfTheDensePseudoInverseOfRandomMatrices) {
  Random random(11);
  int shorter = 0, exact = 0;
  for (int seed = 0; seed < 300; ++seed) {
    const Sparse a = planted(random, seed);
    std::vector<int> groups;
    for (int row = 0; row < a.rows(); row += 1 + random.below(6)) groups.push_back(row);
    Vector x(a.cols());
    for (double& entry : x) entry = random.value();
    const Eigen::JacobiSVD<Dense> svd(Dense(a), Eigen::ComputeThinV);
    const auto rank = (svd.singularValues().array() > 1e-9).count();
    const Dense v = svd.matrixV().leftCols(rank);
    const RowSpace space(a, 1e-9, groups);
    EXPECT_EQ(space.rank(), rank);
    const Vector shortest = space.part(x);
    // what left_out() promises, with rounding of the products and of the dense way beside it
    const double error = (1e-14 + space.left_out()) * a.norm() * x.norm();
    EXPECT_LT((a * (shortest - x)).norm(), error) << "matrix " << seed;
    EXPECT_LT((shortest - v * (v.transpose() * x)).norm(), error / svd.singularValues()[rank - 1]) << "matrix " << seed;
    exact += space.left_out() < 1e-14;
    EXPECT_LT(space.left_out(), 1e-10) << "matrix " << seed;
    shorter += shortest.norm() < 0.99 * x.norm();
  }
  EXPECT_GT(shorter, 100) << "else this judges little";
  EXPECT_GT(exact, 280) << "a row is left out of few matrices by more than rounding";
}

/// Where the columns all but span their space the nearest motion has a meaning: least squares by another way.
TEST(ColumnBasis, LeftNullVectorIsTheNearest) {
  Random random(7);
  Dense a(12, 5);
  for (double& entry : a.reshaped()) entry = random.value();
  a.col(4) = a.col(1) - 2 * a.col(3);
  const Sparse sparse = normalized(a);
  const Vector wish = Vector::Random(12);
  const Vector nearest = wish - a * a.completeOrthogonalDecomposition().solve(wish);
  EXPECT_LT((ColumnBasis(sparse, 1e-9).left_null(wish) - nearest).norm(), 1e-12);
}

TEST(ColumnBasis, EmptyColumnsAreDependentAndRowsWithoutColumnsFree) {
  Sparse a(3, 2);
  a.insert(1, 1) = 1;
  const ColumnBasis basis(a, 1e-9);
  EXPECT_EQ(basis.dependent(), std::vector<int>{0});
  EXPECT_EQ(basis.left_null(Vector::Ones(3)), Vector(Eigen::Vector3d(1, 0, 1)));
  EXPECT_EQ(ColumnBasis(Sparse(0, 2), 1e-9).rank(), 0);
  EXPECT_EQ(ColumnBasis(Sparse(2, 0), 1e-9).rank(), 0);
}

/// Links of six rows, joined to the next by five columns: a chain, with both ends held a loop.
Sparse links(int count, bool closed) {
  Random random(1);
  std::vector<Eigen::Triplet<double>> entries;
  const int joints = closed ? count + 1 : count;
  for (int joint = 0; joint < joints; ++joint)
    for (int j = 0; j < 5; ++j)
      for (const int link : {joint - 1, joint})
        for (int i = 0; link >= 0 && link < count && i < 6; ++i)
          entries.emplace_back(6 * link + i, 5 * joint + j, random.value());
  Sparse a(6 * count, 5 * joints);
  a.setFromTriplets(entries.begin(), entries.end());
  for (Eigen::Index j = 0; j < a.cols(); ++j) a.col(j) /= a.col(j).norm();
  return a;
}

std::vector<int> groups_of_six(int count) {
  std::vector<int> groups;
  for (int i = 0; i < count; ++i) groups.push_back(6 * i);
  return groups;
}

TEST(ColumnBasis, OpenChainsAreAllLeaves) {
  const ColumnBasis basis(links(2000, false), 1e-9, groups_of_six(2000));
  EXPECT_EQ(basis.rank(), 10000);
  EXPECT_EQ(basis.factor_entries(), 0u);
}

/// Counted work, not time: entries of R for each link stay the same however many links there are.
TEST(ColumnBasis, LoopsCostByTheLink) {
  const auto entries_per_link = [](int count) {
    const ColumnBasis basis(links(count, true), 1e-9, groups_of_six(count));
    EXPECT_EQ(basis.rank(), 5 * (count + 1));
    return static_cast<double>(basis.factor_entries()) / count;
  };
  const double few = entries_per_link(100);
  EXPECT_LT(entries_per_link(10000), 1.3 * few);
}

/// Bodies on one carrier: a QR of all would be full.
TEST(ColumnBasis, StarsCostByTheBody) {
  constexpr int bodies = 2000;
  Random random(5);
  std::vector<Eigen::Triplet<double>> entries;
  for (int body = 1; body <= bodies; ++body)
    for (int j = 0; j < 6; ++j)
      for (const int at : {0, body})
        for (int i = 0; i < 6; ++i) entries.emplace_back(6 * at + i, 6 * (body - 1) + j, (i == j ? 2 : 0) + random.value());
  Sparse a(6 * (bodies + 1), 6 * bodies);
  a.setFromTriplets(entries.begin(), entries.end());
  for (Eigen::Index j = 0; j < a.cols(); ++j) a.col(j) /= a.col(j).norm();
  const ColumnBasis basis(a, 1e-9, groups_of_six(bodies + 1));
  EXPECT_EQ(basis.rank(), 6 * bodies);
  EXPECT_LT(basis.factor_entries(), 100u * bodies);
}

}  // namespace
}  // namespace engrane::solve
