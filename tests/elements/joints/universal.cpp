// SPDX-License-Identifier: BSD-3-Clause
#include "elements/joints/universal.hpp"

#include "elements/joints/joint_cases.hpp"

namespace engrane::elements::joints {
namespace {

using namespace suite;

JointData pins(int a, int b) {
  JointData data = joint_data(a, b);
  data.second = {{0.5, 0.3, 0}};
  return data;
}

TEST(Universal, Suite) {
  run_suite(joint_subject("joint", universal_type, pins(1, 2)));
  run_suite(joint_subject("a on the ground", universal_type, pins(0, 2)));
  run_suite(joint_subject("b on the ground", universal_type, pins(2, 0)));
}

TEST(Universal, SuiteWithSprings) {
  JointData data = pins(2, 1);
  data.turn().stiffness = 7;
  run_suite(joint_subject("springs", universal_type, data));
  data.turn().damping = 2;
  run_suite(damped(joint_subject("springs and dampers", universal_type, data)));
}

TEST(Universal, SuiteWithAllOptions) {
  run_coordinate(universal_type, pins(1, 2), turn_of, "ANGLE", true, 1);
  run_coordinate(universal_type, pins(1, 2), turn_b_of, "ANGLE", true, 1);
}

TEST(Universal, SuiteWithFriction) { run_friction(universal_type, pins(1, 2), true, 1); }
TEST(Universal, SuiteAtRestAndSliding) { run_grips(universal_type, pins(1, 2), true, {}, 1); }

TEST(Universal, Extremes) { run_joint_extremes(universal_type, pins(1, 2)); }

TEST(Universal, PinsOneAfterTheOther) {
  // B is turned from the cross about B's pin, and the cross from A about A's
  JointData data;
  data.axis = {1, 0, 0};
  data.second = {{0, 1, 0}};
  JointAtOrigin joint(universal_type, data);
  const double alpha = 2.2, beta = -1.3;
  joint.state.turn(1, rotation_exp({alpha, 0, 0}) * rotation_exp({0, beta, 0}), Vec3::Zero());
  for (const double gap : joint.gaps()) EXPECT_NEAR(gap, 0, 1e-15);
  EXPECT_NEAR(joint.channel("ANGLE_1"), alpha, 1e-14);
  EXPECT_NEAR(joint.channel("ANGLE_2"), beta, 1e-14);
}

/// Shafts along x and, bent by β about y, along (cos β, 0, −sin β); A's pin is z, B's y.
struct Shafts {
  explicit Shafts(double beta)
      : second(std::cos(beta), 0, -std::sin(beta)), joint(build(universal_type(), data(), nodes())), state(*joint, nodes()) {}
  static NodeMap nodes() { return {{0, Vec3::Zero()}, {1, Vec3::Zero()}, {2, Vec3::Zero()}}; }
  static JointData data() {
    JointData data;
    data.axis = {0, 0, 1};
    data.second = {{0, 1, 0}};
    data.nodes = {1, 2};
    data.at = {{0, 0, 0}};
    return data;
  }
  void turn(double theta_1, double theta_2) {
    state.turn(0, rotation_exp({theta_1, 0, 0}), Vec3::Zero());
    state.turn(1, rotation_exp(theta_2 * second), Vec3::Zero());
  }
  double gap() const { return residual_of(*joint, state).back(); }

  Vec3 second;  ///< direction of B's shaft
  std::unique_ptr<Element> joint;
  StateBuffer state;
};

TEST(Universal, PinsThroughManyTurns) {
  // shaft A turns a thousand times while B, bent from it by 45 degrees, follows: the pins swing and nothing is lost
  const double beta = std::numbers::pi / 4;
  Shafts shafts(beta);
  for (int i = 0; i <= 12000; ++i) {
    const double theta = std::numbers::pi / 6 * i;
    shafts.turn(theta, std::atan2(std::sin(theta), std::cos(theta) * std::cos(beta)));
    ASSERT_NEAR(shafts.gap(), 0, 1e-11) << i;
    shafts.state.commit(*shafts.joint);
    ASSERT_LE(std::abs(channel_of(*shafts.joint, shafts.state, "ANGLE_1")), beta + 1e-9) << i;
    ASSERT_LE(std::abs(channel_of(*shafts.joint, shafts.state, "ANGLE_2")), 2 * beta + 1e-9) << i;  // from where it starts, bent
  }
}

TEST(Universal, FrictionOfThePins) {
  // a torque T across the pins presses their bearings, L apart, with 2 T/L
  JointData data;
  data.axis = {1, 0, 0};
  data.second = {{0, 1, 0}};
  data.friction = {"CONST", {0.1}};
  data.friction_width = 1e-4;
  data.radius = 0.02;
  data.bearing_length = 0.08;
  JointAtOrigin joint(universal_type, data);
  joint.move(Vec3::Zero(), {2, -3, 0});
  joint.state.multipliers = {0, 0, 0, 40};
  EXPECT_NEAR(joint.channel("PRESSING_FORCE_1"), 2 * 40 / 0.08, 1e-10);
  EXPECT_NEAR(joint.channel("FRICTION_MOMENT_1"), 0.1 * 0.02 * 1000, 1e-12);
  EXPECT_NEAR(joint.channel("FRICTION_POWER_1"), 2 * 2, 1e-12);
  EXPECT_NEAR(joint.channel("FRICTION_POWER_2"), 2 * 3, 1e-12);
  EXPECT_NEAR(joint.channel("MOMENT_1"), -2, 1e-12);
  EXPECT_NEAR(joint.channel("MOMENT_2"), 2, 1e-12);
}

TEST(Universal, SpeedsOfBentShafts) {
  // tan θ2 = tan θ1 / cos β
  const double beta = 0.6;
  Shafts shafts(beta);
  for (double theta = -1.5; theta < 1.5; theta += 0.25) {
    shafts.turn(theta, std::atan(std::tan(theta) / std::cos(beta)));
    EXPECT_NEAR(shafts.gap(), 0, 1e-15) << theta;
  }
}

TEST(Universal, FaultsOfTheCard) {
  JointData data = pins(1, 2);
  data.axis = {1, 0, 0};
  data.second = {{1, 1, 0}};
  EXPECT_EQ(joint_fault(universal_type, data), "the pins are at 45 degrees");
  data.at.reset();
  EXPECT_EQ(joint_fault(universal_type, data), "nodes 1 and 2 of the universal joint are 5 apart");
}

}  // namespace
}  // namespace engrane::elements::joints
