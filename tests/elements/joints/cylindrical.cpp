// SPDX-License-Identifier: BSD-3-Clause
#include "elements/joints/cylindrical.hpp"

#include "elements/joints/joint_cases.hpp"

namespace engrane::elements::joints {
namespace {

using namespace suite;

TEST(Cylindrical, Suite) {
  run_suite(joint_subject("joint", cylindrical_type, joint_data(1, 2)));
  run_suite(joint_subject("a on the ground", cylindrical_type, joint_data(0, 2)));
  run_suite(joint_subject("b on the ground", cylindrical_type, joint_data(2, 0)));
}

TEST(Cylindrical, SuiteWithSlideSpring) {
  JointData data = joint_data(2, 1);
  data.slide().stiffness = 12;
  run_suite(joint_subject("spring", cylindrical_type, data));
  data.slide().damping = 3;
  run_suite(damped(joint_subject("spring and damper", cylindrical_type, data)));
}

TEST(Cylindrical, SuiteWithDrivenSlide) {
  for (const char* kind : {"SLIDE", "SPEED"}) {
    JointData data = joint_data(1, 2);
    data.slide().drive.tag = kind;
    data.slide().function = 1;
    run_suite(driven(joint_subject(std::string("driven in ") + kind, cylindrical_type, data)));
  }
}

TEST(Cylindrical, SuiteWithTorsionSpring) {
  JointData data = joint_data(2, 1);
  data.turn().stiffness = 7;
  run_suite(joint_subject("spring", cylindrical_type, data));
  data.turn().damping = 2;
  run_suite(damped(joint_subject("spring and damper", cylindrical_type, data)));
}

TEST(Cylindrical, SuiteWithDrivenTurn) {
  for (const char* kind : {"ANGLE", "SPEED"}) {
    JointData data = joint_data(1, 2);
    data.turn().drive.tag = kind;
    data.turn().function = 1;
    run_suite(driven(joint_subject(std::string("driven in ") + kind, cylindrical_type, data)));
  }
}

TEST(Cylindrical, SuiteWithAllOptions) {
  run_coordinate(cylindrical_type, joint_data(1, 2), slide_of, "SLIDE", false);
  run_coordinate(cylindrical_type, joint_data(1, 2), turn_of, "ANGLE", true);
}

TEST(Cylindrical, SuiteWithFriction) { run_friction(cylindrical_type, joint_data(1, 2)); }
TEST(Cylindrical, SuiteAtRestAndSliding) { run_grips(cylindrical_type, joint_data(1, 2)); }

TEST(Cylindrical, Extremes) { run_joint_extremes(cylindrical_type, joint_data(1, 2)); }

TEST(Cylindrical, SlideAndTurnsAreFree) {
  JointData data;
  data.axis = {0, 3, 0};
  data.turn().stiffness = 2;
  JointAtOrigin joint(cylindrical_type, data);
  for (int third = 1; third <= 3000; ++third) {
    joint.put({0, 0.001 * third, 0}, {0, 2 * std::numbers::pi * (third % 3) / 3, 0});
    joint.accept();
  }
  for (const double gap : joint.gaps()) EXPECT_NEAR(gap, 0, 1e-15);
  EXPECT_NEAR(joint.channel("SLIDE"), 3, 1e-14);
  EXPECT_NEAR(joint.channel("ANGLE"), 2000 * std::numbers::pi, 1e-10);
  EXPECT_NEAR(joint.channel("MOMENT_Y"), -4000 * std::numbers::pi, 1e-9) << "the spring winds up";
}

TEST(Cylindrical, NodesMayBeApartAlongTheAxis) {
  JointData data = joint_data(1, 2);
  data.at.reset();
  EXPECT_EQ(joint_fault(cylindrical_type, data), "nodes 1 and 2 of the cylindrical joint are 5 apart, and not along its axis");
  data.axis = {0, -3, -4};
  const NodeMap nodes = {{0, Vec3::Zero()}, {1, {1, 0, 0}}, {2, {1, 3, 4}}};
  const auto joint = build(cylindrical_type(), data, nodes);
  StateBuffer state(*joint, nodes);
  EXPECT_NEAR(channel_of(*joint, state, "SLIDE"), 0, 1e-15);
}

}  // namespace
}  // namespace engrane::elements::joints
