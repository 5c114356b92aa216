// SPDX-License-Identifier: BSD-3-Clause
#include "elements/joints/point_line.hpp"

#include "elements/joints/joint_cases.hpp"

namespace engrane::elements::joints {
namespace {

using namespace suite;

TEST(PointLine, Suite) {
  run_suite(joint_subject("joint", point_line_type, joint_data(1, 2)));
  run_suite(joint_subject("a on the ground", point_line_type, joint_data(0, 2)));
  run_suite(joint_subject("b on the ground", point_line_type, joint_data(2, 0)));
}

TEST(PointLine, SuiteWithSlideSpring) {
  JointData data = joint_data(2, 1);
  data.slide().stiffness = 12;
  run_suite(joint_subject("spring", point_line_type, data));
  data.slide().damping = 3;
  run_suite(damped(joint_subject("spring and damper", point_line_type, data)));
}

TEST(PointLine, SuiteWithDrivenSlide) {
  for (const char* kind : {"SLIDE", "SPEED"}) {
    JointData data = joint_data(1, 2);
    data.slide().drive.tag = kind;
    data.slide().function = 1;
    run_suite(driven(joint_subject(std::string("driven in ") + kind, point_line_type, data)));
  }
}

TEST(PointLine, SuiteWithAllOptions) { run_coordinate(point_line_type, joint_data(1, 2), slide_of, "SLIDE", false); }

TEST(PointLine, SuiteWithFriction) { run_friction(point_line_type, joint_data(1, 2)); }
TEST(PointLine, SuiteAtRestAndSliding) { run_grips(point_line_type, joint_data(1, 2), false); }

TEST(PointLine, Extremes) { run_joint_extremes(point_line_type, joint_data(1, 2)); }

TEST(PointLine, AsksForNoRotationOfB) {
  JointData data = joint_data(1, 2);
  data.at.reset();
  const Subject s = joint_subject("at b", point_line_type, data);
  run_suite(s);
  EXPECT_EQ(s.build(Mat3::Identity())->layout().needs[0], NodeNeed::both);
  EXPECT_EQ(s.build(Mat3::Identity())->layout().needs[1], NodeNeed::translation);
}

TEST(PointLine, SlidesAndTurnsFreely) {
  JointData data;
  data.axis = {0, 1, 0};
  JointAtOrigin joint(point_line_type, data);
  joint.put({0, 2, 0}, {1, 2, 0.5});
  for (const double gap : joint.gaps()) EXPECT_NEAR(gap, 0, 1e-15);
  EXPECT_NEAR(joint.channel("SLIDE"), 2, 1e-15);
  joint.put({0.3, 2, 0.4}, {1, 2, 0.5});
  EXPECT_NEAR(std::hypot(joint.gaps()[0], joint.gaps()[1]), 0.5, 1e-15);
}

}  // namespace
}  // namespace engrane::elements::joints
