// SPDX-License-Identifier: BSD-3-Clause
#include "elements/joints/prismatic.hpp"

#include "elements/joints/joint_cases.hpp"

namespace engrane::elements::joints {
namespace {

using namespace suite;

TEST(Prismatic, Suite) {
  run_suite(joint_subject("joint", prismatic_type, joint_data(1, 2)));
  run_suite(joint_subject("a on the ground", prismatic_type, joint_data(0, 2)));
  run_suite(joint_subject("b on the ground", prismatic_type, joint_data(2, 0)));
}

TEST(Prismatic, SuiteWithSlideSpring) {
  JointData data = joint_data(2, 1);
  data.slide().stiffness = 12;
  run_suite(joint_subject("spring", prismatic_type, data));
  data.slide().damping = 3;
  run_suite(damped(joint_subject("spring and damper", prismatic_type, data)));
}

TEST(Prismatic, SuiteWithDrivenSlide) {
  for (const char* kind : {"SLIDE", "SPEED"}) {
    JointData data = joint_data(1, 2);
    data.slide().drive.tag = kind;
    data.slide().function = 1;
    run_suite(driven(joint_subject(std::string("driven in ") + kind, prismatic_type, data)));
  }
}

TEST(Prismatic, SuiteWithAllOptions) { run_coordinate(prismatic_type, joint_data(1, 2), slide_of, "SLIDE", false); }

TEST(Prismatic, SuiteWithFriction) { run_friction(prismatic_type, joint_data(1, 2)); }
TEST(Prismatic, SuiteAtRestAndSliding) { run_grips(prismatic_type, joint_data(1, 2)); }

TEST(Prismatic, Extremes) { run_joint_extremes(prismatic_type, joint_data(1, 2)); }

TEST(Prismatic, SlidesAndDoesNotTurn) {
  JointData data;
  data.axis = {0, 0, 2};
  data.slide().stiffness = 100;
  data.slide().relaxed = 0.25;
  JointAtOrigin joint(prismatic_type, data);
  joint.put({0, 0, 0.75}, Vec3::Zero());
  for (const double gap : joint.gaps()) EXPECT_NEAR(gap, 0, 1e-15);
  EXPECT_NEAR(joint.channel("SLIDE"), 0.75, 1e-15);
  EXPECT_NEAR(joint.channel("SLIDE_SPRING"), -50, 1e-13);
  EXPECT_NEAR(joint.channel("FORCE_Z"), -50, 1e-13) << "the spring holds b back";
  EXPECT_NEAR(joint.channel("FORCE_1"), -50, 1e-13);
  // half of 2 tan(0.3) times two about the axis: nothing is lost of a turn about it
  joint.put({0, 0, 0.75}, {0, 0, 0.6});
  EXPECT_NEAR(joint.gaps()[2], 2 * std::tan(0.3), 1e-15);
}

TEST(Prismatic, ReactionsAreTheMultipliers) {
  JointData data;
  data.axis = {1, 0, 0};
  JointAtOrigin joint(prismatic_type, data);
  joint.put({3, 0, 0}, Vec3::Zero());
  joint.state.multipliers = {2, 3, 5, 7, 11};
  EXPECT_NEAR(joint.channel("FORCE_2"), 2, 1e-14);
  EXPECT_NEAR(joint.channel("FORCE_3"), 3, 1e-14);
  EXPECT_NEAR(joint.channel("MOMENT_1"), 5, 1e-14);
  EXPECT_NEAR(joint.channel("MOMENT_2"), 7, 1e-14);
  EXPECT_NEAR(joint.channel("MOMENT_3"), 11, 1e-14);
  EXPECT_NEAR(joint.channel("FORCE_1"), 0, 1e-14);
  EXPECT_NEAR(joint.channel("MOMENT_X"), 5, 1e-14);
  EXPECT_NEAR(joint.channel("RADIAL_FORCE"), std::hypot(2, 3), 1e-14);
  EXPECT_NEAR(joint.channel("BENDING_MOMENT"), std::hypot(7, 11), 1e-14);
}

TEST(Prismatic, FrictionOfShoesAndKey) {
  JointData data;
  data.axis = {1, 0, 0};
  data.friction = {"CONST", {0.3}};
  data.friction_width = 1e-3;
  data.bearing_length = 0.5;
  data.radius = 0.2;
  data.preload = 4;
  JointAtOrigin joint(prismatic_type, data);
  joint.put({3, 0, 0}, Vec3::Zero());
  joint.move({2, 0, 0}, Vec3::Zero());
  // the force 6 along e2 with the moment 4 about e3: shoes carry 3 + 8 and 3 − 8; the moment 1.2 about the axis presses the key
  joint.state.multipliers = {6, 0, 1.2, 0, 4};
  EXPECT_NEAR(joint.channel("PRESSING_FORCE"), 11 + 5 + 6 + 4, 1e-13);
  EXPECT_NEAR(joint.channel("FRICTION_FORCE"), 0.3 * 26, 1e-13);
  EXPECT_NEAR(joint.channel("FORCE_X"), -0.3 * 26, 1e-13);
  EXPECT_NEAR(joint.channel("FRICTION_POWER"), 0.6 * 26, 1e-13);
}

TEST(Prismatic, StopsPushBack) {
  JointData data;
  data.axis = {1, 0, 0};
  data.slide().lower = -0.2;
  data.slide().upper = 0.3;
  data.slide().stop_stiffness = 100;
  JointAtOrigin joint(prismatic_type, data);
  joint.put({0.35, 0, 0}, Vec3::Zero());
  EXPECT_NEAR(joint.channel("SLIDE_STOP"), -5, 1e-13);
  EXPECT_NEAR(joint.channel("SLIDE_GAP"), -0.05, 1e-15);
  EXPECT_NEAR(joint.channel("FORCE_X"), -5, 1e-13);
  joint.put({-0.1, 0, 0}, Vec3::Zero());
  EXPECT_EQ(joint.channel("SLIDE_STOP"), 0);
  EXPECT_NEAR(joint.channel("SLIDE_GAP"), 0.1, 1e-15);
  ASSERT_EQ(joint.joint->layout().switches.size(), 2U);
  EXPECT_EQ(joint.joint->layout().switches[1].rises, "SLIDE: upper stop touches");
}

TEST(Prismatic, FaultsOfTheCard) {
  JointData data = joint_data(1, 2);
  data.slide().function = 1;
  EXPECT_EQ(joint_fault(prismatic_type, data), "NF without DRIVE");
  data.slide().drive.tag = "SLIDE";
  data.slide().function = 0;
  EXPECT_EQ(joint_fault(prismatic_type, data), "DRIVE needs a function of time");
  data.slide().drive.tag = "";
  data.slide().lower = 0.1;
  EXPECT_EQ(joint_fault(prismatic_type, data), "a stop without stiffness: KSTOP is missing");
  data.slide().stop_stiffness = 1;
  data.slide().upper = 0;
  EXPECT_EQ(joint_fault(prismatic_type, data), "MAX 0 is below MIN 0.1");
  data.slide().lower.reset();
  data.slide().upper.reset();
  EXPECT_EQ(joint_fault(prismatic_type, data), "KSTOP describes stops, and there are none");
  data.slide().stop_stiffness = 0;
  data.bearing_length = 1;
  EXPECT_EQ(joint_fault(prismatic_type, data), "LENGTH describes friction, and there is none");
  data.friction = {"CONST", {0.1}};
  data.sticks = true;
  data.friction_width = 1e-3;
  EXPECT_EQ(joint_fault(prismatic_type, data), "STICK regularises nothing, VREG does");
  data.friction_width.reset();
  data.friction = {"CONST", {0.2, 0.1}};
  EXPECT_EQ(joint_fault(prismatic_type, data), "the coefficient at rest is below that of sliding");
  data.sticks = false;
  data.friction = {};
  data.nodes = {1, 1};
  EXPECT_EQ(joint_fault(prismatic_type, data), "node 1 is named twice");
  data.axis = {0, 0, 0};
  EXPECT_EQ(joint_fault(prismatic_type, data), "AXIS 0 0 0 is not a direction");
}

}  // namespace
}  // namespace engrane::elements::joints
