// SPDX-License-Identifier: BSD-3-Clause
#include "elements/screw.hpp"

#include "joint_cases.hpp"

namespace engrane {
namespace {

using namespace suite;

TEST(Screw, Suite) {
  run_suite(joint_subject("joint", screw_type, joint_data(1, 2)));
  run_suite(joint_subject("a on the ground", screw_type, joint_data(0, 2)));
  run_suite(joint_subject("b on the ground", screw_type, joint_data(2, 0)));
}

TEST(Screw, SuiteWithSlideSpring) {
  JointData data = joint_data(2, 1);
  data.stiffness = 12;
  run_suite(joint_subject("spring", screw_type, data));
  data.damping = 3;
  run_suite(damped(joint_subject("spring and damper", screw_type, data)));
}

TEST(Screw, SuiteWithDrivenSlide) {
  for (const char* kind : {"SLIDE", "SPEED"}) {
    JointData data = joint_data(1, 2);
    data.drive.tag = kind;
    data.function = 1;
    run_suite(driven(joint_subject(std::string("driven in ") + kind, screw_type, data)));
  }
}

TEST(Screw, SuiteWithTorsionSpring) {
  JointData data = joint_data(2, 1);
  data.turn_stiffness = 7;
  run_suite(joint_subject("spring", screw_type, data));
  data.turn_damping = 2;
  run_suite(damped(joint_subject("spring and damper", screw_type, data)));
}

TEST(Screw, SuiteWithDrivenTurn) {
  for (const char* kind : {"ANGLE", "SPEED"}) {
    JointData data = joint_data(1, 2);
    data.turn.tag = kind;
    data.turn_function = 1;
    run_suite(driven(joint_subject(std::string("driven in ") + kind, screw_type, data)));
  }
}

TEST(Screw, Extremes) { run_joint_extremes(screw_type, joint_data(1, 2)); }

TEST(Screw, AdvancesByItsPitch) {
  JointData data;
  data.axis = {1, 0, 0};
  data.pitch = -0.5;  // left-hand
  JointAtOrigin joint(screw_type, data);
  for (int third = 1; third <= 30; ++third) {
    joint.put({-0.5 * third / 3, 0, 0}, {2 * std::numbers::pi * (third % 3) / 3, 0, 0});
    for (const double gap : joint.gaps()) EXPECT_NEAR(gap, 0, 1e-13) << third;
    joint.accept();
  }
  EXPECT_NEAR(joint.channel("ANGLE"), 20 * std::numbers::pi, 1e-12);
}

TEST(Screw, ForceAndTorque) {
  // virtual work: F p + M 2π = 0
  JointData data;
  data.axis = {1, 0, 0};
  data.pitch = 0.5;
  JointAtOrigin joint(screw_type, data);
  joint.state.multipliers[4] = 8;
  EXPECT_NEAR(joint.channel("FORCE_1"), 8, 1e-14);
  EXPECT_NEAR(joint.channel("MOMENT_1"), -8 * 0.5 / (2 * std::numbers::pi), 1e-14);
}

TEST(Screw, FaultsOfTheCard) {
  JointData data = joint_data(1, 2);
  data.turn.tag = "ANGLE";
  EXPECT_EQ(joint_fault(screw_type, data), "TURN needs a function of time");
  data.drive.tag = "SLIDE";
  EXPECT_EQ(joint_fault(screw_type, data), "DRIVE and TURN on one screw");
}

}  // namespace
}  // namespace engrane
