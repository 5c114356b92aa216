// SPDX-License-Identifier: BSD-3-Clause
// KLU keeps its pivots from one matrix to the next: the solutions must not show it.
#include <gtest/gtest.h>

#include <algorithm>

#include "linear_system.hpp"

namespace engrane::test {

using namespace solve;

namespace {

/// Matrices in a row for which old pivots did not serve.
double lost_trials(const LinearSystem& system) { return system.memory().number("klu/trials_lost"); }

TEST(Klu, AnyMatrixOfThePatternIsSolvedToRounding) {
  std::mt19937 random(7);
  LinearSystem f(saddle_point(random, 24, 9));
  for (int k = 0; k < 50; ++k) {
    f.set(saddle_point(random, 24, 9));
    ASSERT_TRUE(f.solve(Eigen::VectorXd::Random(33)));
    EXPECT_LT(f.error, 1e-13) << "matrix " << k;
  }
}

TEST(Klu, PivotsThatVanishAreReplaced) {
  LinearSystem f(Eigen::Matrix3d{{4, 1, 2}, {1, 5, 1}, {2, 1, 6}});
  const Eigen::Vector3d b(1, 2, 3);
  ASSERT_TRUE(f.solve(b));
  for (const double pivot : {1e-9, 1e-17, 0.0}) {
    f.set(Eigen::Matrix3d{{pivot, 1, 2}, {1, pivot, 1}, {2, 1, pivot}});
    ASSERT_TRUE(f.solve(b));
    EXPECT_LT(f.error, 1e-15) << "pivot " << pivot;
  }
}

TEST(Klu, RowsThatOnlyRoundingFillsSayNothingOfPivots) {
  // two motions that two constraints hold, as those out of the plane of a mechanism, and two that move together: the first two
  // constraints have nothing but rounding in them
  const auto matrix = [](double turn) {
    const double c = std::cos(turn), s = std::sin(turn);
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(7, 7);
    a.diagonal() << 3.7 + s, 2.9, 1.3, 4.1, 0, 0, 0;
    a(4, 0) = a(0, 4) = 1.1 * c;
    a(4, 1) = a(1, 4) = 0.7 * s;
    a(5, 0) = a(0, 5) = -0.9 * s;
    a(5, 1) = a(1, 5) = 1.3 * c;
    a(6, 2) = a(2, 6) = c;
    a(6, 3) = a(3, 6) = -s;
    return a;
  };
  const Eigen::VectorXd b = (Eigen::VectorXd(7) << 0.3, 0.7, 1.9, 0.4, 0, 0, 0).finished();
  LinearSystem told(matrix(0.5), "KLU", {0, 0, 0, 0, 2, 2, 2}), untold(matrix(0.5));
  double lost = 0;
  for (int k = 0; k < 20; ++k) {
    for (LinearSystem* f : {&told, &untold}) {
      f->set(matrix(0.5 + 0.01 * k));
      ASSERT_TRUE(f->solve(b));
    }
    EXPECT_EQ(lost_trials(told), 0) << "matrix " << k;
    lost = std::max(lost, lost_trials(untold));
    EXPECT_LT((told.x - matrix(0.5 + 0.01 * k).fullPivLu().solve(b)).norm(), 1e-14);
  }
  EXPECT_GT(lost, 0);
}

TEST(Klu, SingularIsSaidAndLeavesNothingBehind) {
  const Eigen::Matrix3d good{{4, 1, 2}, {1, 5, 1}, {2, 1, 6}}, singular{{4, 1, 2}, {1, 5, 1}, {4, 1, 2}};
  const Eigen::Vector3d b(1, 2, 3);
  LinearSystem f(good);
  ASSERT_TRUE(f.solve(b));
  f.set(singular);
  EXPECT_FALSE(f.solve(b));
  f.set(good);
  ASSERT_TRUE(f.solve(b));
  EXPECT_LT((f.x - good.inverse() * b).norm(), 1e-15);
}

TEST(LinearSolver, BadlyScaledMatricesAreSolvedToRounding) {
  // rows and columns of 24 decades: what pivots of 1e-12 leave of others is rounding until the solution is refined
  std::mt19937 random(3);
  std::uniform_real_distribution<double> entry(-1, 1), decade(-6, 6);
  for (const char* package : {"MUMPS", "KLU", "UMFPACK", "SUPERLU"}) {
    LinearSystem f(Eigen::MatrixXd::Identity(40, 40), package);
    double worst = 0;
    for (int k = 0; k < 20; ++k) {
      Eigen::MatrixXd a(40, 40);
      for (Eigen::Index i = 0; i < 40; ++i)
        for (Eigen::Index j = 0; j < 40; ++j) a(i, j) = entry(random);
      for (Eigen::Index i = 0; i < 40; ++i) a.row(i) *= std::pow(10, decade(random));
      for (Eigen::Index j = 0; j < 40; ++j) a.col(j) *= std::pow(10, decade(random));
      f.set(a);
      ASSERT_TRUE(f.solve(Eigen::VectorXd::Random(40))) << package;
      worst = std::max(worst, f.error);
    }
    EXPECT_LT(worst, good_solution) << package;
  }
}

TEST(LinearSolver, EveryPackageSaysThatAMatrixIsSingular) {
  const Eigen::Matrix3d good{{4, 1, 2}, {1, 5, 1}, {2, 1, 6}}, singular{{4, 1, 2}, {1, 5, 1}, {4, 1, 2}};
  const Eigen::Vector3d b(1, 2, 3);
  for (const char* package : {"MUMPS", "KLU", "UMFPACK", "SUPERLU"}) {
    LinearSystem f(good, package);
    ASSERT_TRUE(f.solve(b)) << package;
    f.set(singular);
    EXPECT_FALSE(f.solve(b)) << package;
    f.set(good);
    ASSERT_TRUE(f.solve(b)) << package;
    EXPECT_LT((f.x - good.inverse() * b).norm(), 1e-15) << package;
  }
}

TEST(LinearSolver, TheEstimatedConditionIsThatOfTheMatrix) {
  std::mt19937 random(5);
  for (const char* package : {"MUMPS", "KLU"}) {
    for (int k = 0; k < 10; ++k) {
      const Eigen::MatrixXd a = saddle_point(random, 24, 9);
      const auto norm1 = [](const Eigen::MatrixXd& m) { return m.cwiseAbs().colwise().sum().maxCoeff(); };
      const double exact = norm1(a) * norm1(a.inverse());
      LinearSystem f(a, package);
      ASSERT_TRUE(f.solve(Eigen::VectorXd::Random(33)));
      EXPECT_LT(f.condition(), 1.001 * exact) << package;
      EXPECT_GT(f.condition(), exact / 3) << package;
    }
  }
}

TEST(LinearSolver, AutoTakesKluForChainsAndMumpsForLattices) {
  const auto package = [](int x, int y, int z) {
    const int n = x * y * z;
    Owned<Mat> a;
    check_petsc(MatCreateSeqAIJ(PETSC_COMM_SELF, n, n, 7, nullptr, a.out()));
    const auto couple = [&](int i, int j) {
      check_petsc(MatSetValue(a, i, j, 1, INSERT_VALUES));
      check_petsc(MatSetValue(a, j, i, 1, INSERT_VALUES));
    };
    for (int i = 0; i < n; ++i) {
      couple(i, i);
      if (i % x + 1 < x) couple(i, i + 1);
      if (i / x % y + 1 < y) couple(i, i + x);
      if (i + x * y < n) couple(i, i + x * y);
    }
    check_petsc(MatAssemblyBegin(a, MAT_FINAL_ASSEMBLY));
    check_petsc(MatAssemblyEnd(a, MAT_FINAL_ASSEMBLY));
    return LinearSolver(a, "AUTO").package();
  };
  EXPECT_EQ(package(20000, 1, 1), "KLU");
  EXPECT_EQ(package(10, 10, 1), "KLU");
  EXPECT_EQ(package(18, 18, 18), "MUMPS");
}

}  // namespace
}  // namespace engrane::test
