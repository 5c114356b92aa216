// SPDX-License-Identifier: BSD-3-Clause
#include "assembly/difference.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "math/rotation.hpp"

namespace engrane::test {
namespace {

/// What a motion makes of a configuration.
Configuration moved(const Configuration& from, const std::vector<double>& y) {
  Configuration to = from;
  for (std::size_t i = 0; i < to.nodes.size(); ++i) {
    to.nodes[i].x += Eigen::Map<const Vec3>(&y[6 * i]);
    to.nodes[i].R = from.nodes[i].R * rotation_exp(Vec3(Eigen::Map<const Vec3>(&y[6 * i + 3])));
  }
  for (std::size_t i = 0; i < to.scalars.size(); ++i) to.scalars[i] += y[6 * to.nodes.size() + i];
  return to;
}

Configuration sample(double seed) {
  Configuration c;
  c.nodes.resize(4);
  int k = 0;
  const auto next = [&] { return std::sin(seed + 2.3 * ++k); };
  for (std::size_t i = 1; i < 4; ++i) {
    c.nodes[i].x = 10 * Vec3(next(), next(), next());
    c.nodes[i].R = rotation_exp(Vec3(3 * next(), 3 * next(), 3 * next()));
  }
  c.scalars = {next(), next()};
  return c;
}

TEST(Difference, IsTheMotionFromOneToTheOther) {
  for (int k = 0; k < 20; ++k) {
    const Configuration a = sample(0.1 * k), b = sample(0.17 * k + 5);
    const auto y = difference(a, b);
    const Configuration c = moved(b, y);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_LE((c.nodes[i].x - a.nodes[i].x).norm(), 1e-14);
      EXPECT_LE((c.nodes[i].R - a.nodes[i].R).norm(), 1e-14);
    }
    for (std::size_t i = 0; i < 2; ++i) EXPECT_DOUBLE_EQ(c.scalars[i], a.scalars[i]);
  }
}

TEST(Difference, GivesBackTheMotion) {
  const Configuration b = sample(1);
  std::vector<double> y(6 * 4 + 2);
  for (std::size_t i = 0; i < y.size(); ++i) y[i] = 0.9 * std::cos(1.1 * static_cast<double>(i));
  const auto found = difference(moved(b, y), b);
  for (std::size_t i = 0; i < y.size(); ++i) EXPECT_NEAR(found[i], y[i], 1e-14) << i;
}

TEST(Difference, OfOneAndTheSameIsZero) {
  const Configuration a = sample(2);
  for (const double value : difference(a, a)) EXPECT_EQ(value, 0);
}

TEST(Difference, HalfATurnIsAtMostHalfATurn) {
  Configuration a = sample(3), b = a;
  b.nodes[2].R = a.nodes[2].R * rotation_exp(Vec3(0, std::numbers::pi, 0));
  EXPECT_NEAR(Eigen::Map<const Vec3>(&difference(b, a)[15]).norm(), std::numbers::pi, 1e-14);
}

}  // namespace
}  // namespace engrane::test
