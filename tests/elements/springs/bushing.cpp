// SPDX-License-Identifier: BSD-3-Clause
#include "elements/springs/bushing.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "elements/common/rotation_vector.hpp"
#include "elements/springs/places.hpp"
#include "elements/suite.hpp"
#include "math/rotation.hpp"

namespace engrane::elements::springs {
namespace {

using namespace suite;

/// A positive matrix that couples everything: L Lᵀ of a lower triangle, as the upper triangle by rows.
std::vector<double> coupled(double size) {
  Eigen::Matrix<double, 6, 6> L = Eigen::Matrix<double, 6, 6>::Zero();
  for (Eigen::Index i = 0; i < 6; ++i)
    for (Eigen::Index j = 0; j <= i; ++j)
      L(i, j) = i == j ? 3 + 0.2 * static_cast<double>(i) : std::sin(1.0 + static_cast<double>(3 * i + j));
  const Eigen::Matrix<double, 6, 6> m = size * L * L.transpose();
  std::vector<double> values;
  for (Eigen::Index i = 0; i < 6; ++i)
    for (Eigen::Index j = i; j < 6; ++j) values.push_back(m(i, j));
  return values;
}

Subject subject(std::array<int, 2> ends, const std::vector<double>& stiffness, const std::vector<double>& damping) {
  Subject s;
  s.name = std::to_string(stiffness.size()) + " values of K, " + std::to_string(damping.size()) + " of C";
  s.nodes = places;
  s.build = [=](const Mat3& Q) {
    BushingData data;
    data.nodes = ends;
    data.stiffness = stiffness;
    data.damping = damping;
    data.at = list(Q * Vec3(0.3, -0.6, 0.2));
    data.axis = list(Q * Vec3(0.4, 1, 0.1));
    data.axis_2 = list(Q * Vec3(-0.2, 0.3, 1));
    return build(bushing_type(), data, turned(places, Q));
  };
  s.step = 1e-4;  // close to half a turn the rotation vector bends strongly
  s.tolerance = 1e-7;
  s.turn = 1.2;  // of each node, so that the relative rotation stays below half a turn
  if (!damping.empty()) s.skip[Check::lagrange] = "a damper has no potential";
  return s;
}

TEST(Bushing, Suite) {
  run_suite(subject({1, 2}, {40, 50, 60, 7, 8, 9}, {}));
  run_suite(subject({1, 2}, coupled(5), {}));
  run_suite(subject({1, 2}, coupled(5), coupled(0.4)));
  run_suite(subject({0, 2}, coupled(5), {1, 2, 3, 4, 5, 6}));
  run_suite(subject({1, 0}, coupled(5), {}));
}

TEST(Bushing, Extremes) {
  for (const double size : {1e-6, 1e12}) run_extreme(subject({1, 2}, coupled(size), coupled(size)));
}

TEST(Bushing, RotationVectorIsThatOfTheRotation) {
  Random random(3);
  for (const double angle : {0.0, 1e-9, 1e-4, 0.05, 0.0632, 0.0633, 0.5, 2.0, 2.2, 3.0, 3.1415}) {
    const Vec3 theta = angle * uniform_vector(random).normalized();
    const Mat3 R = rotation_exp(theta);
    const auto found = RotationVector<double>::of(R);
    EXPECT_LE((found.theta - theta).norm(), 1e-14 * (1 + angle)) << angle;
    // exp(θ + δθ) = exp(δφ) exp(θ), and δφ = R times the material increment of rotation_tangent()
    const Vec3 change = uniform_vector(random);
    const Vec3 phi = R * rotation_tangent(theta) * change;
    EXPECT_LE((found.change(phi) - change).norm(), 1e-11) << angle;
    EXPECT_NEAR(found.moment(theta + phi).dot(change), (theta + phi).dot(found.change(change)), 1e-10) << angle;
  }
}

TEST(Bushing, ActsInTheAxesOfTheFirstNode) {
  BushingData data;
  data.nodes = {1, 2};
  data.stiffness = {10, 20, 30, 4, 5, 6};
  const NodeMap nodes = {{1, Vec3::Zero()}, {2, {2, 0, 0}}};
  const auto bush = build(bushing_type(), data, nodes);
  StateBuffer state(*bush, nodes);
  // both turn a quarter about z: what was along x is along y; B is then pulled out along its arm, and twisted about it
  const Mat3 quarter = rotation_exp({0, 0, M_PI / 2});
  state.turn(0, quarter, Vec3::Zero());
  state.turn(1, quarter * rotation_exp({1.5, 0, 0}), Vec3::Zero());
  state.nodes[1].x = {0, 2.5, 0};
  EXPECT_NEAR(channel_of(*bush, state, "DISPLACEMENT_1"), 0.5, 1e-15);
  EXPECT_NEAR(channel_of(*bush, state, "FORCE_1"), -5, 1e-14);
  EXPECT_NEAR(channel_of(*bush, state, "ROTATION_1"), 1.5, 1e-15);
  EXPECT_NEAR(channel_of(*bush, state, "MOMENT_1"), -6, 1e-14);
  EXPECT_NEAR(channel_of(*bush, state, "SPRING_ENERGY"), 0.5 * 10 * 0.25 + 0.5 * 4 * 2.25, 1e-14);
  const auto r = residual_of(*bush, state);
  EXPECT_NEAR(r[7], 5, 1e-14) << "B resists along global y";
  EXPECT_NEAR(r[9], 6, 1e-14) << "and about its own x";
}

TEST(Bushing, FaultsOfTheCard) {
  const auto message = [&](const BushingData& data) {
    Diagnostics diagnostics;
    EXPECT_EQ(build(bushing_type(), data, places, {.diagnostics = &diagnostics}), nullptr);
    return diagnostics.all().empty() ? std::string() : diagnostics.all().front().message;
  };
  BushingData data;
  data.nodes = {1, 2};
  EXPECT_EQ(message(data), "a bush with neither stiffness nor damping does nothing");
  data.stiffness = {1, 1, 1, 1, 1, 1, 1};
  EXPECT_EQ(message(data), "K has 7 values");
  data.stiffness = {1, 1, 1, 1, 1, -1};
  EXPECT_EQ(message(data), "the matrix of K is not positive: some motion would gain energy from it");
  data.stiffness = coupled(1);
  data.axis_2 = {{0, 0, 1}};
  EXPECT_EQ(message(data), "AXIS2 without AXIS");
  data.axis = {{0, 0, -2}};
  EXPECT_EQ(message(data), "AXIS2 is along AXIS");
}

}  // namespace
}  // namespace engrane::elements::springs
