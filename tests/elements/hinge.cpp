// SPDX-License-Identifier: BSD-3-Clause
#include "elements/hinge.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "elements/axis_angle.hpp"
#include "math/rotation.hpp"
#include "suite.hpp"

namespace engrane {
namespace {

using namespace suite;

std::array<double, 3> components(const Vec3& v) { return {v[0], v[1], v[2]}; }

const Vec3 axis(0.3, -0.5, 0.7), point(0.4, 0.1, -0.2);

FunctionMap waves() {
  FunctionMap functions;
  functions[1] = std::make_unique<Wave>(0.3, 0.7, 1.9, 0.4);
  return functions;
}

const FunctionMap functions = waves();

/// Nodes apart, so that both offsets are in play.
Subject subject(std::string name, const HingeData& wished) {
  Subject s;
  s.name = std::move(name);
  s.nodes = {{0, Vec3::Zero()}, {1, {1, 0.2, -0.3}}, {2, {-0.5, 0.4, 0.8}}};
  s.build = [=](const Mat3& Q) {
    HingeData data = wished;
    data.axis = components(Q * axis);
    data.at = components(Q * point);
    return build(hinge_type(), data, turned(s.nodes, Q), {.functions = &functions});
  };
  s.force = 5;
  s.own_axes = true;  // its second and third
  return s;
}

HingeData plain(int a, int b) {
  HingeData data;
  data.nodes = {a, b};
  return data;
}

TEST(Hinge, Suite) {
  run_suite(subject("joint", plain(1, 2)));
  run_suite(subject("on the ground", plain(0, 2)));
}

TEST(Hinge, SuiteWithDrive) {
  for (const char* kind : {"ANGLE", "SPEED"}) {
    HingeData data = plain(1, 2);
    data.drive.tag = kind;
    data.function = 1;
    Subject s = subject(std::string("driven in ") + kind, data);
    s.skip[Check::zero] = "the function is not zero at t = 0";
    s.skip[Check::rigid] = "the function is not zero at t = 0";
    run_suite(s);
  }
}

TEST(Hinge, SuiteWithSpring) {
  HingeData data = plain(2, 1);
  data.stiffness = 12;
  run_suite(subject("spring", data));

  data.damping = 3;
  Subject s = subject("spring and damper", data);
  s.skip[Check::lagrange] = "a damper has no potential";
  run_suite(s);
}

TEST(Hinge, Extremes) {
  for (const double stiffness : {1e-6, 1e15}) {
    for (const double length : {1e-9, 1e6}) {
      Subject s;
      s.name = "stiffness " + std::to_string(stiffness) + " length " + std::to_string(length);
      s.nodes = {{0, Vec3::Zero()}, {1, Vec3(length, 0, 0)}, {2, Vec3(0, length, 0)}};
      s.length = length;
      s.velocity = length;
      s.build = [=](const Mat3&) {
        HingeData data = plain(1, 2);
        data.axis = components(axis * length);
        data.at = components(point * length);
        data.stiffness = stiffness;
        data.damping = stiffness;
        data.drive.tag = "SPEED";
        data.function = 1;
        return build(hinge_type(), data, s.nodes, {.functions = &functions});
      };
      run_extreme(s);
    }
  }
}

TEST(Hinge, CountsAMillionTurns) {
  HingeData data = plain(0, 1);
  data.axis = components(axis);
  data.stiffness = 2;
  const NodeMap nodes = {{0, Vec3::Zero()}, {1, point}};
  const auto hinge = build(hinge_type(), data, nodes);
  StateBuffer state(*hinge, nodes);
  const Vec3 e = axis.normalized();
  // the angle is given exactly at every step, as turns + part
  const int parts = 3;
  for (int turn = 0; turn < 1000000; ++turn)
    for (int part = 0; part < parts; ++part) {
      state.turn(1, rotation_exp(2 * std::numbers::pi * part / parts * e), Vec3::Zero());
      std::vector<double> history = state.history;
      hinge->commit(state.view(), {}, history);
      state.history = history;
    }
  state.turn(1, rotation_exp(0.25 * e), Vec3::Zero());
  EXPECT_NEAR(channel_of(*hinge, state, "ANGLE"), 2e6 * std::numbers::pi + 0.25, 1e-9);
  std::vector<double> history(2);
  hinge->commit(state.view(), {}, history);
  EXPECT_EQ(history[0], 1e6);
  EXPECT_NEAR(history[1], 0.25, 1e-15);
}

TEST(Hinge, GradientOfTheAngleIsTheSumOfAxes) {
  // δθ by differences of the atan2 formula, for axes far from parallel
  const AxisTriad triad(axis.normalized());
  Random random(3);
  for (int i = 0; i < 20; ++i) {
    const Mat3 a = uniform_rotation(random), b = uniform_rotation(random);
    const Vec3 gradient = axis_angle(triad, a, b).gradient;
    for (int c = 0; c < 3; ++c) {
      const double h = 1e-5;
      const Vec3 e = Vec3::Unit(c);
      const double plus = axis_angle(triad, a, Mat3(rotation_exp(h * e) * b)).angle,
                   minus = axis_angle(triad, a, Mat3(rotation_exp(-h * e) * b)).angle;
      EXPECT_NEAR(std::remainder(plus - minus, 2 * std::numbers::pi) / (2 * h), gradient[c],
                  1e-6 * (1 + std::pow(gradient.norm(), 3)));
    }
  }
}

TEST(Hinge, ReactionOfAHangingWeight) {
  // what the joint does to node 2, by its channels, from multipliers set by hand in joint axes
  HingeData data = plain(0, 1);
  data.axis = {0, 0, 1};
  data.at = {{0, 0, 0}};
  const NodeMap nodes = {{0, Vec3::Zero()}, {1, {2, 0, 0}}};
  const auto hinge = build(hinge_type(), data, nodes);
  StateBuffer state(*hinge, nodes);
  state.multipliers = {7, 0, 0, 0, 0};
  EXPECT_NEAR(channel_of(*hinge, state, "FORCE_Z"), 7, 1e-15);
  EXPECT_NEAR(channel_of(*hinge, state, "AXIAL_FORCE"), 7, 1e-15);
  EXPECT_NEAR(channel_of(*hinge, state, "RADIAL_FORCE"), 0, 1e-15);
  EXPECT_NEAR(channel_of(*hinge, state, "BENDING_MOMENT"), 0, 1e-15);
  const auto r = residual_of(*hinge, state);
  EXPECT_NEAR(r[6 + 4], -14, 1e-14) << "7 along z at the joint turns the node, 2 along x from it, about +y";
}

TEST(Hinge, FaultsOfTheCard) {
  const NodeMap nodes = {{0, Vec3::Zero()}, {1, {1, 0, 0}}, {2, {1, 3, 4}}};
  const auto message = [&](const HingeData& data) {
    Diagnostics diagnostics;
    EXPECT_EQ(build(hinge_type(), data, nodes, {.functions = &functions, .diagnostics = &diagnostics}), nullptr);
    return diagnostics.all().empty() ? std::string() : diagnostics.all().front().message;
  };
  HingeData data = plain(1, 2);
  data.axis = {0, 0, 1};
  EXPECT_EQ(message(data), "nodes 1 and 2 of the hinge are 5 apart");
  data.nodes = {1, 1};
  EXPECT_EQ(message(data), "node 1 is named twice");
  data.nodes = {0, 1};
  data.function = 1;
  EXPECT_EQ(message(data), "NF without DRIVE");
  data.function = 0;
  data.drive.tag = "ANGLE";
  EXPECT_EQ(message(data), "DRIVE needs a function of time");
  data.drive.tag = "";
  data.axis = {0, 0, 0};
  EXPECT_EQ(message(data), "AXIS 0 0 0 is not a direction");
}

}  // namespace
}  // namespace engrane
