// SPDX-License-Identifier: BSD-3-Clause
#include "elements/gears/gear_geometry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "math/angle.hpp"

namespace engrane {

using namespace elements::gears;

namespace {

double largest(const Mat3& m) { return m.cwiseAbs().maxCoeff(); }

GearDesign design(std::array<int, 2> teeth, double module, std::array<double, 2> cone, std::array<double, 2> helix) {
  GearDesign d;
  d.teeth = teeth;
  d.normal_module = module;
  d.pressure_angle = 20 * degree;
  d.cone = {cone[0] * degree, cone[1] * degree};
  d.helix = {paper_helix(helix[0] * degree, d.cone[0]), paper_helix(helix[1] * degree, d.cone[1])};
  return d;
}

/// Where B must be when A is at the origin with the triad mu.
Vec3 place_of_b(const GearDesign& d, const Mat3& mu) {
  return d.radius(0) * mu.col(1) - d.radius(1) * (mu * wheel_to_wheel(d)).col(1);
}

TEST(GearGeometry, ToothAxesAreRotations) {
  for (const double cone : {0.0, 30.0, -79.0, 180.0, 150.0})
    for (const double helix : {0.0, 25.0, -60.0}) {
      const Mat3 Y = tooth_axes(cone * degree, helix * degree), Y_b = mating_tooth_axes(cone * degree, helix * degree);
      EXPECT_LT(largest(Y * Y.transpose() - Mat3::Identity()), 1e-15);
      EXPECT_NEAR(Y.determinant(), 1, 1e-15);
      EXPECT_NEAR(Y_b.determinant(), 1, 1e-15);
    }
}

TEST(GearGeometry, RightHandToothIsARightHandScrew) {
  // a right-hand screw: going out along the axle, the tooth turns in the positive sense about the way it goes
  for (const double cone : {0.0, 40.0, -40.0}) {
    const Vec3 tooth = tooth_axes(cone * degree, paper_helix(20 * degree, cone * degree)).col(0);
    EXPECT_GT(tooth[0] * tooth[2], 0) << cone;
  }
  const Vec3 ring = tooth_axes(180 * degree, paper_helix(20 * degree, 180 * degree)).col(0);
  EXPECT_GT(ring[0] * ring[2], 0);
}

TEST(GearGeometry, HandsOfParallelAxles) {
  EXPECT_EQ(design({20, 40}, 2, {0, 0}, {15, -15}).parallel_kind(), 1);
  EXPECT_EQ(design({20, 40}, 2, {0, 0}, {15, 15}).parallel_kind(), 0);
  EXPECT_EQ(design({20, 40}, 2, {0, 180}, {15, 15}).parallel_kind(), -1);
  EXPECT_EQ(design({40, 20}, 2, {180, 0}, {15, 15}).parallel_kind(), -2);
  EXPECT_EQ(design({20, 40}, 2, {0, 180}, {15, -15}).parallel_kind(), 0);
}

TEST(GearGeometry, WheelToWheelDependsOnTheSumOfHelices) {
  auto d = design({20, 40}, 2, {35, -20}, {0, 0});
  d.helix = {0.3, -0.1};
  const Mat3 Z = wheel_to_wheel(d);
  d.helix = {-0.5, 0.7};
  EXPECT_LT(largest(Z - wheel_to_wheel(d)), 1e-15);
}

TEST(GearGeometry, RandomCrossedPairsClose) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(-1, 1);
  double worst_place = 0, worst_triad = 0, worst_misfit = 0;
  for (int i = 0; i < 2000; ++i) {
    GearDesign d;
    d.teeth = {5 + static_cast<int>(40 * std::abs(u(random))), 5 + static_cast<int>(40 * std::abs(u(random)))};
    d.normal_module = 1 + u(random) / 2;
    d.cone = {80 * degree * u(random), 80 * degree * u(random)};
    d.helix = {60 * degree * u(random), 60 * degree * u(random)};
    const Mat3 mu = Eigen::Quaterniond(u(random), u(random), u(random), u(random)).normalized().toRotationMatrix();
    const Vec3 x_a(u(random), u(random), u(random)), x_b = x_a + place_of_b(d, mu), axle = mu.col(0);
    const Closure c = closure(d, x_a, x_b, axle);
    if (c.distance_needed < 1e-2 * c.size) continue;  // the same circle: no contact point to be told
    worst_misfit = std::max(worst_misfit, c.misfit());
    const PitchFrames f = pitch_frames(d, x_a, x_b, axle);
    const double condition = c.size / c.distance_needed;
    worst_triad = std::max(worst_triad, largest(f.mu - mu) / condition);
    const Vec3 gap = x_a + d.radius(0) * f.mu.col(1) - x_b - d.radius(1) * f.xi.col(1);
    worst_place = std::max(worst_place, gap.norm() / c.size / condition);
    EXPECT_LT(largest(f.mu * tooth_axes(d.cone[0], d.helix[0]) - f.xi * mating_tooth_axes(d.cone[1], d.helix[1])), 1e-14);
  }
  EXPECT_LT(worst_misfit, 1e-15 * 4);
  EXPECT_LT(worst_triad, 1e-14);
  EXPECT_LT(worst_place, 1e-14);
}

TEST(GearGeometry, CentreDistances) {
  const Vec3 z(0, 0, 1);
  // Özgüven's spur pair, and the same wheels as an internal pair
  EXPECT_NEAR(closure(design({25, 25}, 0.15748, {0, 0}, {0, 0}), {0, 0, 0}, {1, 0, 0}, z).distance_needed, 3.937, 1e-14);
  EXPECT_NEAR(closure(design({20, 60}, 2, {0, 180}, {0, 0}), {0, 0, 0}, {1, 0, 0}, z).distance_needed, 40, 1e-13);
  EXPECT_NEAR(closure(design({60, 20}, 2, {180, 0}, {0, 0}), {0, 0, 0}, {1, 0, 0}, z).distance_needed, 40, 1e-13);
  EXPECT_NEAR(closure(design({25, 25}, 2, {0, 180}, {0, 0}), {0, 0, 0}, {1, 0, 0}, z).distance_needed, 0, 1e-13);
  // helical: m_n (z_A + z_B)/(2 cosβ)
  EXPECT_NEAR(closure(design({20, 40}, 2, {0, 0}, {15, -15}), {0, 0, 0}, {1, 0, 0}, z).distance_needed,
              60 / std::cos(15 * degree), 1e-13);
}

TEST(GearGeometry, PaperBevelCloses) {
  const auto d = design({50, 10}, 0.2, {-std::atan(5) / degree, -std::atan(0.2) / degree}, {0, 0});
  EXPECT_NEAR(d.radius(0), 5, 1e-15);
  const Closure c = closure(d, {0, 0, 0}, {0, 1, 5}, {0, 1, 0});
  EXPECT_LT(c.misfit(), 1e-15);
  const PitchFrames f = pitch_frames(d, {0, 0, 0}, {0, 1, 5}, {0, 1, 0});
  EXPECT_LT((f.contact - Vec3(0, 0, 5)).norm(), 1e-15);
  EXPECT_LT((f.xi.col(0) - Vec3(0, 0, -1)).norm(), 1e-15);
  EXPECT_LT((f.xi.col(1) - Vec3(0, -1, 0)).norm(), 1e-15);
}

TEST(GearGeometry, ConesOfShaftAngle) {
  const auto right = cones_of_shaft_angle(90 * degree, {50, 10});
  EXPECT_NEAR(right[0], std::atan(5), 1e-15);
  EXPECT_NEAR(right[1], std::atan(0.2), 1e-15);
  for (const double shaft : {40.0, 75.0, 110.0, 150.0}) {
    const auto g = cones_of_shaft_angle(shaft * degree, {17, 31});
    EXPECT_NEAR(g[0] + g[1], shaft * degree, 1e-15);
    EXPECT_NEAR(std::sin(g[0]) / std::sin(g[1]), 17.0 / 31, 1e-15);
  }
}

TEST(GearGeometry, ShaftAngleOfAxles) {
  EXPECT_NEAR(shaft_angle_of_axles({0, 0, 0}, {0, 1, 0}, {0, 1, 5}, {0, 0, 1}).value(), 90 * degree, 1e-15);
  const Vec3 b(std::sin(2), 0, std::cos(2));
  EXPECT_NEAR(shaft_angle_of_axles({0, 0, 3}, {0, 0, 1}, 2 * b, b).value(), 2, 1e-14);
  EXPECT_NEAR(shaft_angle_of_axles({0, 0, 3}, {0, 0, 1}, 2 * b, -b).value(), 2, 1e-14);
  EXPECT_FALSE(shaft_angle_of_axles({0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 0, 1}));  // parallel
  EXPECT_FALSE(shaft_angle_of_axles({0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}));  // passing
}

TEST(GearGeometry, ContactRatios) {
  // closed form with the pressure angle at the tip of an external wheel, cos = r_b/(r + m): an independent way to write it
  const auto half = [](double z, double alpha) {
    return z * (std::tan(std::acos(z * std::cos(alpha) / (z + 2))) - std::tan(alpha));
  };
  const double two_pi = 2 * std::numbers::pi;
  EXPECT_NEAR(contact_ratio(design({20, 40}, 3, {0, 0}, {0, 0})).value(),
              (half(20, 20 * degree) + half(40, 20 * degree)) / two_pi, 1e-14);
  const auto ring = [](double z, double alpha) {
    return z * (std::tan(alpha) - std::tan(std::acos(z * std::cos(alpha) / (z - 2))));
  };
  EXPECT_NEAR(contact_ratio(design({20, 60}, 3, {0, 180}, {0, 0})).value(),
              (half(20, 20 * degree) + ring(60, 20 * degree)) / two_pi, 1e-14);
  // a bevel pair by its virtual wheels of z/cos 45 teeth; axles that pass each other have none
  EXPECT_NEAR(contact_ratio(design({20, 20}, 3, {45, 45}, {0, 0})).value(),
              half(20 * std::sqrt(2), 20 * degree) / std::numbers::pi, 1e-14);
  EXPECT_FALSE(contact_ratio(design({20, 20}, 3, {0, 0}, {30, 40})));
}

}  // namespace
}  // namespace engrane
