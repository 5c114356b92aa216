// SPDX-License-Identifier: BSD-3-Clause
#include "elements/joints/hinge.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "elements/common/axis_angle.hpp"
#include "elements/joints/joint_cases.hpp"
#include "math/rotation.hpp"

namespace engrane::elements::joints {
namespace {

using namespace suite;

const Vec3 axis(0.3, -0.5, 0.7);

TEST(Hinge, Suite) {
  run_suite(joint_subject("joint", hinge_type, joint_data(1, 2)));
  run_suite(joint_subject("a on the ground", hinge_type, joint_data(0, 2)));
  run_suite(joint_subject("b on the ground", hinge_type, joint_data(2, 0)));
}

TEST(Hinge, SuiteWithDrive) {
  for (const char* kind : {"ANGLE", "SPEED"}) {
    JointData data = joint_data(1, 2);
    data.turn().drive.tag = kind;
    data.turn().function = 1;
    run_suite(driven(joint_subject(std::string("driven in ") + kind, hinge_type, data)));
  }
}

TEST(Hinge, SuiteWithSpring) {
  JointData data = joint_data(2, 1);
  data.turn().stiffness = 12;
  run_suite(joint_subject("spring", hinge_type, data));
  data.turn().damping = 3;
  run_suite(damped(joint_subject("spring and damper", hinge_type, data)));
}

TEST(Hinge, SuiteWithAllOptions) { run_coordinate(hinge_type, joint_data(1, 2), turn_of, "ANGLE", true); }

TEST(Hinge, SuiteWithFriction) { run_friction(hinge_type, joint_data(1, 2)); }
TEST(Hinge, SuiteAtRestAndSliding) { run_grips(hinge_type, joint_data(1, 2)); }

TEST(Hinge, Extremes) { run_joint_extremes(hinge_type, joint_data(1, 2)); }

TEST(Hinge, CountsAMillionTurns) {
  JointData data;
  data.axis = components(axis);
  data.turn().stiffness = 2;
  JointAtOrigin joint(hinge_type, data);
  StateBuffer& state = joint.state;
  const Vec3 e = axis.normalized();
  // the angle is given exactly at every step, as turns + part
  const int parts = 3;
  for (int turn = 0; turn < 1000000; ++turn)
    for (int part = 0; part < parts; ++part) {
      state.turn(1, rotation_exp(2 * std::numbers::pi * part / parts * e), Vec3::Zero());
      joint.accept();
    }
  state.turn(1, rotation_exp(0.25 * e), Vec3::Zero());
  EXPECT_NEAR(joint.channel("ANGLE"), 2e6 * std::numbers::pi + 0.25, 1e-9);
  joint.accept();
  EXPECT_EQ(state.history[0], 1e6);
  EXPECT_NEAR(state.history[1], 0.25, 1e-15);
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
  JointData data;
  data.nodes = {0, 1};
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

TEST(Hinge, FrictionOfBushesAndCollar) {
  JointData data;
  data.axis = {0, 0, 1};
  data.friction = {"CONST", {0.2}};
  data.friction_width = 1e-3;
  data.radius = 0.05;
  data.collar = 0.08;
  data.bearing_length = 0.4;
  JointAtOrigin joint(hinge_type, data);
  joint.put(Vec3::Zero(), {0, 0, 0.7});
  joint.move(Vec3::Zero(), {0, 0, -2});
  // e1 = z; in the plane of e2 the force 10 and, about e3, the moment 3: bushes carry 5 + 3/0.4 and 5 − 3/0.4
  joint.state.multipliers = {7, 10, 0, 0, 3};
  EXPECT_NEAR(joint.channel("PRESSING_FORCE"), 2 * 7.5 + 7, 1e-13);
  const double moment = 0.2 * (0.05 * 15 + 0.08 * 7);
  EXPECT_NEAR(joint.channel("FRICTION_MOMENT"), moment, 1e-13);
  EXPECT_NEAR(joint.channel("MOMENT_Z"), moment, 1e-13) << "against the spin";
  EXPECT_NEAR(joint.channel("FRICTION_POWER"), 2 * moment, 1e-13);
  // regularised: p(x) = x (15 − 10 x² + 3 x⁴)/8 with x = 0.05·0.004/1e-3 at the bushes, 0.32 at the collar
  joint.move(Vec3::Zero(), {0, 0, 0.004});
  const auto p = [](double x) { return x * (15 - 10 * x * x + 3 * x * x * x * x) / 8; };
  EXPECT_NEAR(joint.channel("FRICTION_MOMENT"), 0.2 * (0.05 * 15 * p(0.2) + 0.08 * 7 * p(0.32)), 1e-13);
}

TEST(Hinge, FaultsOfTheCard) {
  JointData data;
  data.nodes = {1, 2};
  data.axis = {0, 0, 1};
  EXPECT_EQ(joint_fault(hinge_type, data), "nodes 1 and 2 of the hinge are 5 apart");
  data.nodes = {1, 1};
  EXPECT_EQ(joint_fault(hinge_type, data), "node 1 is named twice");
  data.nodes = {0, 1};
  data.turn().function = 1;
  EXPECT_EQ(joint_fault(hinge_type, data), "NF without DRIVE");
  data.turn().function = 0;
  data.turn().drive.tag = "ANGLE";
  EXPECT_EQ(joint_fault(hinge_type, data), "DRIVE needs a function of time");
  data.turn().drive.tag = "";
  data.axis = {0, 0, 0};
  EXPECT_EQ(joint_fault(hinge_type, data), "AXIS 0 0 0 is not a direction");
}

}  // namespace
}  // namespace engrane::elements::joints
