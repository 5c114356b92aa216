// SPDX-License-Identifier: BSD-3-Clause
#include "elements/bodies/rigid_body.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "elements/suite.hpp"
#include "math/rotation.hpp"

namespace engrane::elements::bodies {
namespace {

using namespace suite;

Mat3 body_tensor() {
  Mat3 J;
  J << 2.1, 0.2, -0.3, 0.2, 1.7, 0.4, -0.3, 0.4, 2.6;
  return J;
}

Subject subject(std::string name, const std::vector<int>& nodes, double mass = 0, double size = 1) {
  Subject s;
  s.name = std::move(name);
  s.nodes = {{0, Vec3::Zero()}, {1, {1, 0.2, -0.3}}, {2, {-0.5, 0.4, 0.8}}, {3, {0.1, -0.7, 0.5}}};
  for (auto& [id, x] : s.nodes) x *= size;
  s.length = s.velocity = size;
  s.build = [=](const Mat3& Q) {
    RigidBodyData data;
    data.nodes = nodes;
    if (mass > 0) {
      data.mass = {mass};
      const Mat3 t = mass * size * size * Q * body_tensor() * Q.transpose();
      data.tensor = {t(0, 0), t(1, 1), t(2, 2), t(0, 1), t(1, 2), t(2, 0)};
      const Vec3 center = size * Q * Vec3(0.2, 0.3, -0.1);
      data.centers = {center[0], center[1], center[2]};
    }
    return build(rigid_body_type(), data, turned(s.nodes, Q));
  };
  s.turn = 2;  // rotation vectors change their sign at half a turn
  s.own_axes = true;
  if (mass > 0) {
    s.mass = mass;
    s.skip[Check::rigid] = "inertia resists a rigid motion";
    s.skip[Check::equilibrium] = "inertia pushes against space";
  }
  return s;
}

/// Relative rotations of both signs, less than half a turn apart.
void stay_near_the_master(StateBuffer& state, Random& random) {
  for (std::size_t i = 1; i < state.nodes.size(); ++i)
    if (!state.is_ground(i)) state.turn(i, state.nodes[0].R * rotation_exp(uniform_vector(random)), 0.4 * uniform_vector(random));
}

TEST(RigidBody, Suite) {
  for (const auto& nodes : {std::vector<int>{1, 2}, {1, 2, 3}, {0, 2}, {2, 0}}) {
    Subject s = subject("massless", nodes);
    s.adjust = stay_near_the_master;
    run_suite(s);
  }
  for (const auto& nodes : {std::vector<int>{1}, {1, 2}, {3, 2, 1}}) {
    Subject s = subject("with inertia", nodes, 2.5);
    s.adjust = stay_near_the_master;
    run_suite(s);
  }
}

TEST(RigidBody, Extremes) {
  for (const double size : {1e-9, 1e6})
    for (const double mass : {1e-6, 1e15}) run_extreme(subject("extreme", {1, 2, 3}, mass, size));
}

TEST(RigidBody, HalfATurnIsNoZeroOfTheConstraints) {
  // the antisymmetric part of the relative rotation vanishes there; the rotation vector grows on
  const Subject s = subject("", {1, 2});
  const auto body = s.build(Mat3::Identity());
  StateBuffer state(*body, s.nodes);
  double last = 0;
  for (const double angle : {0.5, 1.0, 2.0, 3.0, 3.14}) {
    state.turn(1, rotation_exp({0, angle, 0}), Vec3::Zero());
    const auto r = residual_of(*body, state);
    EXPECT_NEAR(-r[12 + 4], angle, 1e-12);
    EXPECT_GT(-r[12 + 4], last);
    last = -r[12 + 4];
  }
}

TEST(RigidBody, ReactionChannels) {
  const Subject s = subject("", {1, 2});
  const auto body = s.build(Mat3::Identity());
  StateBuffer state(*body, s.nodes);
  const Mat3 R = rotation_exp({0, 0, std::numbers::pi / 2});
  for (std::size_t i = 0; i < 2; ++i) {
    state.nodes[i].x = R * state.nodes[i].x;
    state.turn(i, R, Vec3::Zero());
  }
  state.multipliers = {5, 0, 0, 0, 0, 7};
  EXPECT_NEAR(channel_of(*body, state, "FORCE_X_2"), 0, 1e-14);
  EXPECT_NEAR(channel_of(*body, state, "FORCE_Y_2"), 5, 1e-14) << "the master's x axis points along global y";
  EXPECT_NEAR(channel_of(*body, state, "MOMENT_Z_2"), 7, 1e-14);
}

TEST(RigidBody, FaultsOfTheCard) {
  const NodeMap nodes = {{0, Vec3::Zero()}, {1, Vec3::Zero()}, {2, Vec3::Zero()}};
  const auto message = [&](const RigidBodyData& data) {
    Diagnostics diagnostics;
    EXPECT_EQ(build(rigid_body_type(), data, nodes, {.diagnostics = &diagnostics}), nullptr);
    return diagnostics.all().empty() ? std::string() : diagnostics.all().front().message;
  };
  RigidBodyData data;
  data.nodes = {1};
  EXPECT_EQ(message(data), "a rigid body of one node without inertia does nothing");
  data.nodes = {1, 2, 1};
  EXPECT_EQ(message(data), "node 1 is named twice");
  data.nodes = {1, 2};
  data.centers = {1, 0, 0};
  EXPECT_EQ(message(data), "CG without mass");
  data.nodes = {0, 2};
  data.mass = {1};
  EXPECT_EQ(message(data), "the first node carries the inertia, and the ground cannot");
  data.nodes = {1, 2};
  data.tensor = {1, 2};
  EXPECT_EQ(message(data), "J has 2 values for one body");
  data.mass = {1, 2};
  EXPECT_EQ(message(data), "CG has 3 values, M has 2");
  data.centers.clear();
  data.tensor = {1, 2, 3, 4};
  EXPECT_EQ(message(data), "J has 4 values for 2 parts (as many as M has values)");
  data.tensor = {1, 2};
  data.axes = {1, 0, 0};
  EXPECT_EQ(message(data), "AXES has 3 values for 2 parts (as many as M has values)");
  data.axes = {1, 0, 0, 2, 0, 0};
  EXPECT_EQ(message(data), "AXES gives one direction only");
  data.axes.clear();
  data.about = {0, 0, 2};
  EXPECT_EQ(message(data), "J moved to the centre of mass of part 1 has a negative principal value: -3, -3, 1");
  data.tensor.clear();
  EXPECT_EQ(message(data), "ABOUT without J");
}

/// Of a block of sides a, b, c about its centre.
Mat3 block(double mass, double a, double b, double c) {
  return Vec3(b * b + c * c, c * c + a * a, a * a + b * b).asDiagonal() * (mass / 12);
}

TEST(RigidBody, PartsMakeOneBody) {
  // a block of 3 x 1 x 2 cut across into pieces of 1 and 2, away from the node
  const NodeMap nodes = {{1, {0.5, -1, 2}}, {2, {4, 0, 0}}};
  const Vec3 corner(1, 2, -1);
  RigidBodyData whole, cut;
  whole.nodes = cut.nodes = {1, 2};
  whole.mass = {6};
  const auto diagonal = [](const Mat3& J) { return std::array{J(0, 0), J(1, 1), J(2, 2)}; };
  for (const double v : diagonal(block(6, 3, 1, 2))) whole.tensor.push_back(v);
  whole.centers = {corner[0] + 1.5, corner[1] + 0.5, corner[2] + 1};
  cut.mass = {2, 4};
  for (const double length : {1, 2})
    for (const double v : diagonal(block(2 * length, length, 1, 2))) cut.tensor.push_back(v);
  cut.centers = {corner[0] + 0.5, corner[1] + 0.5, corner[2] + 1, corner[0] + 2, corner[1] + 0.5, corner[2] + 1};
  const auto one = build(rigid_body_type(), whole, nodes), two = build(rigid_body_type(), cut, nodes);
  EXPECT_LT((one->inertia_at(1) - two->inertia_at(1)).norm(), 1e-13 * one->inertia_at(1).norm());
  const StateBuffer state(*two, nodes);
  for (const char* name : {"CENTER_X", "CENTER_Y", "CENTER_Z"})
    EXPECT_NEAR(channel_of(*two, state, name), channel_of(*one, state, name), 1e-14) << name;
}

TEST(RigidBody, TensorInOtherAxesAboutAnotherPoint) {
  // a slender rod from the node along d: m l²/3 across it, about its end
  const Vec3 end(0.3, -0.2, 0.7), d = Vec3(1, 2, -2) / 3;
  const NodeMap nodes = {{1, end}, {2, end + 1.5 * d}};
  RigidBodyData data;
  data.nodes = {1, 2};
  data.mass = {4};
  const Vec3 middle = end + 0.75 * d;
  data.centers = {middle[0], middle[1], middle[2]};
  data.tensor = {0, 3, 3};
  data.axes = {5 * d[0], 5 * d[1], 5 * d[2], 1, 0, 0};
  data.about = {end[0], end[1], end[2]};
  const Mat3 expected = 3 * (Mat3::Identity() - d * d.transpose());
  EXPECT_LT((build(rigid_body_type(), data, nodes)->inertia_at(1) - expected).norm(), 1e-14);
  // the same about the other end
  data.about = {end[0] + 1.5 * d[0], end[1] + 1.5 * d[1], end[2] + 1.5 * d[2]};
  EXPECT_LT((build(rigid_body_type(), data, nodes)->inertia_at(1) - expected).norm(), 1e-14);
  // principal values about three axes at right angles, from six values in turned ones: a block seen from a corner's axes
  const double angle = 0.4, c = std::cos(angle), s = std::sin(angle);
  const Mat3 turn = rotation_exp({0, 0, angle}), J = block(4, 1, 2, 3);
  const Mat3 seen = turn.transpose() * J * turn;
  data.tensor = {seen(0, 0), seen(1, 1), seen(2, 2), seen(0, 1), seen(1, 2), seen(2, 0)};
  data.axes = {c, s, 0, -s, c, 0};
  data.about.clear();
  data.centers.clear();
  EXPECT_LT((build(rigid_body_type(), data, nodes)->inertia_at(1) - J).norm(), 1e-14);
}

}  // namespace
}  // namespace engrane::elements::bodies
