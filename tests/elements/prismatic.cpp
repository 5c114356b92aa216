// SPDX-License-Identifier: BSD-3-Clause
#include "elements/prismatic.hpp"

#include "joint_cases.hpp"

namespace engrane {
namespace {

using namespace suite;

TEST(Prismatic, Suite) {
  run_suite(joint_subject("joint", prismatic_type, joint_data(1, 2)));
  run_suite(joint_subject("a on the ground", prismatic_type, joint_data(0, 2)));
  run_suite(joint_subject("b on the ground", prismatic_type, joint_data(2, 0)));
}

TEST(Prismatic, SuiteWithSlideSpring) {
  JointData data = joint_data(2, 1);
  data.stiffness = 12;
  run_suite(joint_subject("spring", prismatic_type, data));
  data.damping = 3;
  run_suite(damped(joint_subject("spring and damper", prismatic_type, data)));
}

TEST(Prismatic, SuiteWithDrivenSlide) {
  for (const char* kind : {"SLIDE", "SPEED"}) {
    JointData data = joint_data(1, 2);
    data.drive.tag = kind;
    data.function = 1;
    run_suite(driven(joint_subject(std::string("driven in ") + kind, prismatic_type, data)));
  }
}

TEST(Prismatic, Extremes) { run_joint_extremes(prismatic_type, joint_data(1, 2)); }

TEST(Prismatic, SlidesAndDoesNotTurn) {
  JointData data;
  data.axis = {0, 0, 2};
  data.stiffness = 100;
  data.slide0 = 0.25;
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

TEST(Prismatic, FaultsOfTheCard) {
  JointData data = joint_data(1, 2);
  data.function = 1;
  EXPECT_EQ(joint_fault(prismatic_type, data), "NF without DRIVE");
  data.drive.tag = "SLIDE";
  data.function = 0;
  EXPECT_EQ(joint_fault(prismatic_type, data), "DRIVE needs a function of time");
  data.nodes = {1, 1};
  EXPECT_EQ(joint_fault(prismatic_type, data), "node 1 is named twice");
  data.axis = {0, 0, 0};
  EXPECT_EQ(joint_fault(prismatic_type, data), "AXIS 0 0 0 is not a direction");
}

}  // namespace
}  // namespace engrane
