// SPDX-License-Identifier: BSD-3-Clause
#include "elements/rigid_body.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "math/rotation.hpp"
#include "suite.hpp"

namespace engrane {
namespace {

using namespace suite;

Mat3 tensor() {
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
      data.mass = mass;
      const Mat3 t = mass * size * size * Q * tensor() * Q.transpose();
      data.tensor = {t(0, 0), t(1, 1), t(2, 2), t(0, 1), t(1, 2), t(2, 0)};
      const Vec3 center = size * Q * Vec3(0.2, 0.3, -0.1);
      data.center = {{center[0], center[1], center[2]}};
    }
    return build(rigid_body_type(), data, turned(s.nodes, Q));
  };
  s.turn = 2;  // the Rodrigues vectors of half a turn are infinite
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
  // the antisymmetric part of the relative rotation vanishes there; these constraints grow beyond bounds
  const Subject s = subject("", {1, 2});
  const auto body = s.build(Mat3::Identity());
  StateBuffer state(*body, s.nodes);
  double last = 0;
  for (const double angle : {0.5, 1.0, 2.0, 3.0, 3.14}) {
    state.turn(1, rotation_exp({0, angle, 0}), Vec3::Zero());
    const auto r = residual_of(*body, state);
    EXPECT_NEAR(-r[12 + 4], 2 * std::tan(angle / 2), 1e-12 * std::tan(angle / 2) * std::tan(angle / 2));
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
  data.center = {{1, 0, 0}};
  EXPECT_EQ(message(data), "CG without mass");
  data.nodes = {0, 2};
  data.mass = 1;
  EXPECT_EQ(message(data), "the first node carries the inertia, and the ground cannot");
  data.mass = 0;
  data.center.reset();
  data.tensor = {1, 2};
  EXPECT_EQ(message(data), "J has 2 values");
}

}  // namespace
}  // namespace engrane
