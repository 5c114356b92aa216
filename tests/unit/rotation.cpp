// SPDX-License-Identifier: BSD-3-Clause
#include "math/rotation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "math/linear_rotation.hpp"

namespace engrane {
namespace {

const Vec3 direction = Vec3(1, -2, 0.5).normalized();

double defect(const Mat3& R) { return (R.transpose() * R - Mat3::Identity()).cwiseAbs().maxCoeff(); }

TEST(Rotation, ExponentialIsARotation) {
  for (const double angle : {0.0, 1e-300, 1e-12, 1e-8, 1e-4, 0.3, 1.0, std::numbers::pi, 6.0, 1e3, 1e6}) {
    const Mat3 R = rotation_exp(angle * direction);
    EXPECT_LT(defect(R), 4e-15) << angle;
    EXPECT_NEAR(R.determinant(), 1, 4e-15);
    EXPECT_LT((R * direction - direction).norm(), 1e-15 * (1 + angle));
  }
  const Mat3 quarter = rotation_exp(Vec3(0, 0, std::numbers::pi / 2));
  EXPECT_LT((quarter * Vec3::UnitX() - Vec3::UnitY()).norm(), 1e-15);
}

TEST(Rotation, LogarithmUndoesTheExponential) {
  const double half_turn = std::numbers::pi;
  for (const double angle : {0.0, 1e-200, 1e-12, 1e-8, 1e-3, 0.3, 1.0, 3.0, half_turn - 1e-3, half_turn - 1e-8}) {
    const Vec3 y = angle * direction;
    EXPECT_LT((rotation_log(rotation_exp(y)) - y).norm(), 4e-15 * std::max(angle, 1e-200) + (angle < 1e-10 ? 1e-24 : 0)) << angle;
  }
  EXPECT_NEAR(rotation_log(rotation_exp(half_turn * direction)).norm(), half_turn, 1e-15 * 4);
  // half a turn is one vector, whichever side rounding falls on
  const Vec3 below = rotation_log(rotation_exp((half_turn - 1e-13) * direction)),
             above = rotation_log(rotation_exp((half_turn + 1e-13) * direction));
  EXPECT_LT((below - above).norm(), 1e-12);
  EXPECT_LT((rotation_exp(below) - rotation_exp((half_turn - 1e-13) * direction)).norm(), 1e-14);
  EXPECT_NEAR(rotation_log(rotation_exp((2 * half_turn + 0.1) * direction)).dot(direction), 0.1, 4e-15);
  EXPECT_NEAR(rotation_log(rotation_exp(4.0 * direction)).norm(), 2 * half_turn - 4, 4e-15);
}

TEST(Rotation, LinearisedMatricesHaveVectorsOfAnyLength) {
  for (const double angle : {1e-9, 1e-6, 1e-3, 1.0, 4.0, 1e3, 1e9}) {
    const Vec3 theta = angle * direction;
    const Mat3 R = linear_rotation(theta);
    EXPECT_EQ(is_linear_rotation(R), angle > 1e-7) << angle;
    EXPECT_LT((rotation_log(R) - theta).norm(), 4e-15 * angle) << angle;
    // increments of the matrix are those of the vector
    using D = Dual<1>;
    const Vec3 turn(0.3, 0.7, -0.4);
    Mat3T<D> moved = R.cast<D>();
    const Mat3 change = R * skew(turn);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) moved(i, j).d[0] = change(i, j);
    if (!is_linear_rotation(R)) continue;
    const Vec3T<D> found = linear_rotation_vector(moved);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(found[i].d[0], turn[i], 1e-14 * (1 + angle)) << angle;
    EXPECT_EQ(moment_on_node(R, turn), turn);
  }
  for (const double angle : {0.0, 1e-9, 1e-8, 2e-8, 1e-7, 2e-7, 1e-3, 1.0, 6.0})
    for (const Vec3& axis : {direction, Vec3(Vec3::UnitZ())})
      EXPECT_FALSE(is_linear_rotation(rotation_exp(angle * axis))) << angle;
}

TEST(Rotation, TangentIsTheDerivative) {
  const Vec3 dy(0.3, 0.7, -0.4);
  for (const double angle : {0.0, 1e-9, 1e-3, 0.2999, 0.3001, 1.0, 3.0, 6.0, 20.0}) {
    const Vec3 y = angle * direction;
    const double h = 1e-5;
    const Mat3 R = rotation_exp(y);
    const Vec3 forward = rotation_log(R.transpose() * rotation_exp(y + h * dy));
    const Vec3 backward = rotation_log(R.transpose() * rotation_exp(y - h * dy));
    EXPECT_LT(((forward - backward) / (2 * h) - rotation_tangent(y) * dy).norm(), 1e-9) << angle;
  }
}

TEST(Rotation, TangentHasNoSeamWhereTheSeriesEnds) {
  const Mat3 below = rotation_tangent(0.3 * (1 - 1e-15) * direction), above = rotation_tangent(0.3 * (1 + 1e-15) * direction);
  EXPECT_LT((below - above).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(Rotation, RateOfTheTangentIsItsDerivative) {
  const Vec3 rate(0.3, 1.2, -0.5), w(-0.7, 0.2, 0.9);
  for (const double angle : {0.0, 1e-3, 0.3, 0.499, 0.501, 2.0, 6.0}) {
    const Vec3 y = angle * direction;
    const double h = 1e-5;
    const Mat3 difference = (rotation_tangent(y + h * rate) - rotation_tangent(y - h * rate)) / (2 * h);
    EXPECT_LT((rotation_tangent_rate(y, rate, w) - difference * w).norm(), 1e-9) << angle;
    EXPECT_LT((rotation_tangent_rate(y, rate, rate) - difference * rate).norm(), 1e-9) << angle;
  }
}

TEST(Rotation, OrthonormalizedTakesRoundingAway) {
  Mat3 R = rotation_exp(2.0 * direction);
  R(0, 1) += 1e-9;
  R(2, 2) -= 2e-9;
  EXPECT_LT(defect(orthonormalized(R)), 1e-15 * 4);
  EXPECT_LT((orthonormalized(R) - R).cwiseAbs().maxCoeff(), 3e-9);
}

TEST(Vector, PerpendicularIsUnitAndAtRightAngles) {
  for (const Vec3& a : {Vec3(0, 0, 1), Vec3(1, 0, 0), direction, Vec3(-0.6, 0.8, 0)}) {
    EXPECT_NEAR(perpendicular(a).norm(), 1, 1e-15);
    EXPECT_NEAR(perpendicular(a).dot(a), 0, 1e-15);
  }
  EXPECT_EQ(perpendicular(direction), perpendicular(direction));
}

}  // namespace
}  // namespace engrane
