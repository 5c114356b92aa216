// SPDX-License-Identifier: BSD-3-Clause
#include "elements/joints/constant_velocity.hpp"

#include "elements/joints/joint_cases.hpp"

namespace engrane::elements::joints {
namespace {

using namespace suite;

JointData bent(int a, int b) {
  JointData data = joint_data(a, b);
  data.second = {{0.6, 0.1, 0.4}};
  return data;
}

TEST(ConstantVelocity, Suite) {
  run_suite(joint_subject("in line", constant_velocity_type, joint_data(1, 2)));
  run_suite(joint_subject("a on the ground", constant_velocity_type, joint_data(0, 2)));
  run_suite(joint_subject("b on the ground", constant_velocity_type, joint_data(2, 0)));
  run_suite(joint_subject("bent", constant_velocity_type, bent(1, 2)));
}

TEST(ConstantVelocity, Extremes) { run_joint_extremes(constant_velocity_type, bent(1, 2)); }

/// Shaft A along x, shaft B bent from it by β about y, each turned about itself.
struct Shafts {
  explicit Shafts(double bend) : shaft(std::cos(bend), 0, -std::sin(bend)) {
    JointData data;
    data.axis = {1, 0, 0};
    data.second = components(shaft);
    data.nodes = {1, 2};
    data.at = {{0, 0, 0}};
    joint = build(constant_velocity_type(), data, nodes);
    state = std::make_unique<StateBuffer>(*joint, nodes);
  }
  void turn(double first, double second) {
    state->turn(0, rotation_exp({first, 0, 0}), Vec3::Zero());
    state->turn(1, rotation_exp(second * shaft), Vec3::Zero());
  }
  double twist() const { return -residual_of(*joint, *state)[12]; }

  Vec3 shaft;
  NodeMap nodes = {{0, Vec3::Zero()}, {1, Vec3::Zero()}, {2, Vec3::Zero()}};
  std::unique_ptr<Element> joint;
  std::unique_ptr<StateBuffer> state;
};

TEST(ConstantVelocity, EqualTurnsOfBentShafts) {
  for (const double bend : {0.0, 0.6, std::numbers::pi / 4, 1.5, 2.8}) {
    Shafts s(bend);
    for (double angle = -1000; angle < 1000; angle += 17.3) {
      s.turn(angle, angle);
      EXPECT_NEAR(s.twist(), 0, 1e-12) << bend << " " << angle;
    }
    s.turn(0.4, 0.5);
    EXPECT_GT(std::abs(s.twist()), 0.09) << "unequal turns are seen at a bend of " << bend;
    EXPECT_NEAR(channel_of(*s.joint, *s.state, "BEND"), bend, 1e-12);
  }
}

TEST(ConstantVelocity, TorqueOfBentShafts) {
  // M (u + v)/(1 + u·v): the torque about either shaft, and M tan(β/2) across it, in the plane of the shafts
  const double bend = 0.9;
  Shafts s(bend);
  s.state->multipliers = {5, 0, 0, 0};
  const Vec3 moment(channel_of(*s.joint, *s.state, "MOMENT_X"), channel_of(*s.joint, *s.state, "MOMENT_Y"),
                    channel_of(*s.joint, *s.state, "MOMENT_Z"));
  EXPECT_NEAR(moment[0], 5, 1e-14);
  EXPECT_NEAR(moment.dot(s.shaft), 5, 1e-14);
  EXPECT_NEAR(moment[1], 0, 1e-14);
  EXPECT_NEAR(moment[2], -5 * std::tan(bend / 2), 1e-14);
  EXPECT_NEAR(channel_of(*s.joint, *s.state, "TORQUE"), 5, 1e-14);
}

TEST(ConstantVelocity, TheConstraintKeepsItsSizeAtAnyBend) {
  // |gradient| = 1/cos(β/2): never small, and large near 180 degrees only
  for (double bend = 0; bend < 3; bend += 0.1) {
    const Shafts s(bend);
    const auto k = tangent_of(*s.joint, *s.state, {1, 0, 0});
    const std::size_t n = 12 + 4;
    double square = 0;
    for (std::size_t c = 9; c < 12; ++c) square += k[12 * n + c] * k[12 * n + c];
    EXPECT_NEAR(std::sqrt(square) * std::cos(bend / 2), 1, 1e-12);
  }
}

TEST(ConstantVelocity, FaultsOfTheCard) {
  JointData data = joint_data(1, 2);
  data.axis = {1, 0, 0};
  data.second = {{-1, 0, 0.01}};
  EXPECT_EQ(joint_fault(constant_velocity_type, data), "the shafts are bent by 179.427 degrees");
  data.second = {{0, 0, 0}};
  EXPECT_EQ(joint_fault(constant_velocity_type, data), "AXIS2 0 0 0 is not a direction");
  data.at.reset();
  EXPECT_EQ(joint_fault(constant_velocity_type, data), "nodes 1 and 2 of the constant velocity joint are 5 apart");
}

}  // namespace
}  // namespace engrane::elements::joints
