// SPDX-License-Identifier: BSD-3-Clause
// MUMPS factors a symmetric matrix as such, and another one by LU: the solutions must not show it.
#include <gtest/gtest.h>

#include "linear_system.hpp"

namespace engrane::test {

namespace {

enum Form { unknown, definite, symmetric, general };  // as Mumps has them

int form(const LinearSystem& system) { return static_cast<int>(system.memory().number("solver/MUMPS form")); }

Eigen::MatrixXd random_definite(int size) {
  const Eigen::MatrixXd a = Eigen::MatrixXd::Random(size, size);
  return a * a.transpose() + Eigen::MatrixXd::Identity(size, size);
}

TEST(Mumps, TakesTheFormThatFits) {
  std::srand(3);
  std::mt19937 random(3);
  const Eigen::MatrixXd spd = random_definite(20), saddle = saddle_point(random, 14, 6);
  Eigen::MatrixXd skew = spd;
  skew(3, 7) *= 1.01;
  for (const auto& [matrix, expected] : {std::pair{spd, definite}, {saddle, symmetric}, {skew, general}}) {
    LinearSystem system(matrix, "MUMPS");
    ASSERT_TRUE(system.solve(Eigen::VectorXd::Random(20)));
    EXPECT_EQ(form(system), expected);
    EXPECT_LT(system.error, 1e-14);
  }
}

TEST(Mumps, SymmetryMayBeLostOnTheWay) {
  std::srand(4);
  Eigen::MatrixXd a = random_definite(20);
  const Eigen::VectorXd b = Eigen::VectorXd::Random(20);
  LinearSystem system(a, "MUMPS");
  for (const double part : {0.0, 0.0, 1e-13, 1e-9, 0.3, 0.0}) {
    Eigen::MatrixXd changed = a;
    changed(2, 5) *= 1 + part;
    system.set(changed);
    ASSERT_TRUE(system.solve(b));
    EXPECT_LT(system.error, 1e-14) << "unsymmetric by " << part;
    EXPECT_EQ(form(system), part > 1e-12 || form(system) == general ? general : definite);
  }
  EXPECT_EQ(form(system), general);
}

TEST(Mumps, PivotsOfTheDiagonalMayVanish) {
  // the second pivot of the first is zero in any order of elimination that begins with the first row
  LinearSystem regular(Eigen::Matrix3d{{1, 1, 0}, {1, 1, 1}, {0, 1, 1}}, "MUMPS");
  ASSERT_TRUE(regular.solve(Eigen::Vector3d(1, 2, 4)));
  EXPECT_LT(regular.error, 1e-15);
  LinearSystem indefinite(Eigen::Matrix2d{{1e-12, 1}, {1, 1e-12}}, "MUMPS");
  ASSERT_TRUE(indefinite.solve(Eigen::Vector2d(1, 2)));
  EXPECT_LT(indefinite.error, 1e-15);
  LinearSystem singular(Eigen::Matrix2d{{1, 1}, {1, 1}}, "MUMPS");
  EXPECT_FALSE(singular.solve(Eigen::Vector2d(1, 2)));
}

}  // namespace
}  // namespace engrane::test
