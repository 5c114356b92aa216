// SPDX-License-Identifier: BSD-3-Clause
#include "elements/joints/planar.hpp"

#include "elements/joints/joint_cases.hpp"

namespace engrane::elements::joints {
namespace {

using namespace suite;

TEST(Planar, Suite) {
  run_suite(joint_subject("joint", planar_type, joint_data(1, 2)));
  run_suite(joint_subject("a on the ground", planar_type, joint_data(0, 2)));
  run_suite(joint_subject("b on the ground", planar_type, joint_data(2, 0)));
}

TEST(Planar, SuiteWithTorsionSpring) {
  JointData data = joint_data(2, 1);
  data.turn().stiffness = 7;
  run_suite(joint_subject("spring", planar_type, data));
  data.turn().damping = 2;
  run_suite(damped(joint_subject("spring and damper", planar_type, data)));
}

TEST(Planar, SuiteWithDrivenTurn) {
  for (const char* kind : {"ANGLE", "SPEED"}) {
    JointData data = joint_data(1, 2);
    data.turn().drive.tag = kind;
    data.turn().function = 1;
    run_suite(driven(joint_subject(std::string("driven in ") + kind, planar_type, data)));
  }
}

TEST(Planar, SuiteWithSprings) {
  JointData data = joint_data(2, 1);
  data.second = {{1, 0.5, 2}};
  data.both_stiffness = 12;
  run_suite(joint_subject("springs", planar_type, data));
  data.both_damping = 3;
  run_suite(damped(joint_subject("springs and dampers", planar_type, data)));
}

TEST(Planar, SuiteWithAllOptions) {
  JointData data = joint_data(1, 2);
  data.second = {{1, 0.5, 2}};
  run_coordinate(planar_type, data, slide_of, "SLIDE", false);
  run_coordinate(planar_type, data, slide_b_of, "SLIDE", false);
  run_coordinate(planar_type, data, turn_of, "ANGLE", true);
}

TEST(Planar, SuiteWithFriction) { run_friction(planar_type, joint_data(1, 2)); }
TEST(Planar, SuiteAtRestAndSliding) {
  JointData data = joint_data(1, 2);
  data.second = {{1, 0.5, 2}};  // the direction of sliding is kept in these axes
  run_grips(planar_type, data);
}

TEST(Planar, Extremes) { run_joint_extremes(planar_type, joint_data(1, 2)); }

TEST(Planar, SlidesAndTurns) {
  JointData data;
  data.axis = {0, 0, 1};
  data.second = {{0, 2, 5}};  // only its part in the plane counts
  data.both_stiffness = 10;
  JointAtOrigin joint(planar_type, data);
  joint.put({3, 4, 0}, {0, 0, 2.5});
  for (const double gap : joint.gaps()) EXPECT_NEAR(gap, 0, 1e-15);
  EXPECT_NEAR(joint.channel("SLIDE_2"), 4, 1e-14);
  EXPECT_NEAR(joint.channel("SLIDE_3"), -3, 1e-14);
  EXPECT_NEAR(joint.channel("ANGLE"), 2.5, 1e-14);
  EXPECT_NEAR(joint.channel("FORCE_X"), -30, 1e-13);
  EXPECT_NEAR(joint.channel("FORCE_Y"), -40, 1e-13);
  joint.state.multipliers = {6, 0, 0};
  EXPECT_NEAR(joint.channel("FORCE_1"), 6, 1e-14);
}

TEST(Planar, FrictionOfSlidingAndSpinning) {
  JointData data;
  data.axis = {0, 0, 1};
  data.friction = {"CONST", {0.5}};
  data.friction_width = 1e-3;
  data.radius = 2;
  JointAtOrigin joint(planar_type, data);
  joint.move({1, 2, 0}, {0, 0, 1});  // sliding velocity (1, 2) and, at radius 2, 2: size 3
  joint.state.multipliers = {12, 0, 0};
  EXPECT_NEAR(joint.channel("FORCE_X"), -6.0 / 3, 1e-13);
  EXPECT_NEAR(joint.channel("FORCE_Y"), -12.0 / 3, 1e-13);
  EXPECT_NEAR(joint.channel("MOMENT_Z"), -6 * 2 * 2.0 / 3, 1e-13);
  EXPECT_NEAR(joint.channel("FRICTION_POWER"), 18, 1e-12);
}

TEST(Planar, FaultsOfTheCard) {
  JointData data = joint_data(1, 2);
  data.both_stiffness = data.slide().stiffness = 2;
  EXPECT_EQ(joint_fault(planar_type, data), "K gives both slides, and K2 or its law one of them");
  data.second = data.axis;
  EXPECT_EQ(joint_fault(planar_type, data), "DIR is along the normal AXIS");
}

}  // namespace
}  // namespace engrane::elements::joints
