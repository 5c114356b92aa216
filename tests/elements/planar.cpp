// SPDX-License-Identifier: BSD-3-Clause
#include "elements/planar.hpp"

#include "joint_cases.hpp"

namespace engrane {
namespace {

using namespace suite;

TEST(Planar, Suite) {
  run_suite(joint_subject("joint", planar_type, joint_data(1, 2)));
  run_suite(joint_subject("a on the ground", planar_type, joint_data(0, 2)));
  run_suite(joint_subject("b on the ground", planar_type, joint_data(2, 0)));
}

TEST(Planar, SuiteWithTorsionSpring) {
  JointData data = joint_data(2, 1);
  data.turn_stiffness = 7;
  run_suite(joint_subject("spring", planar_type, data));
  data.turn_damping = 2;
  run_suite(damped(joint_subject("spring and damper", planar_type, data)));
}

TEST(Planar, SuiteWithDrivenTurn) {
  for (const char* kind : {"ANGLE", "SPEED"}) {
    JointData data = joint_data(1, 2);
    data.turn.tag = kind;
    data.turn_function = 1;
    run_suite(driven(joint_subject(std::string("driven in ") + kind, planar_type, data)));
  }
}

TEST(Planar, SuiteWithSprings) {
  JointData data = joint_data(2, 1);
  data.second = {{1, 0.5, 2}};
  data.stiffness = 12;
  run_suite(joint_subject("springs", planar_type, data));
  data.damping = 3;
  run_suite(damped(joint_subject("springs and dampers", planar_type, data)));
}

TEST(Planar, Extremes) { run_joint_extremes(planar_type, joint_data(1, 2)); }

TEST(Planar, SlidesAndTurns) {
  JointData data;
  data.axis = {0, 0, 1};
  data.second = {{0, 2, 5}};  // only its part in the plane counts
  data.stiffness = 10;
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

TEST(Planar, FaultsOfTheCard) {
  JointData data = joint_data(1, 2);
  data.second = data.axis;
  EXPECT_EQ(joint_fault(planar_type, data), "DIR is along the normal AXIS");
}

}  // namespace
}  // namespace engrane
