// SPDX-License-Identifier: BSD-3-Clause
#include "elements/joints/point_plane.hpp"

#include "elements/joints/joint_cases.hpp"

namespace engrane::elements::joints {
namespace {

using namespace suite;

TEST(PointPlane, Suite) {
  run_suite(joint_subject("joint", point_plane_type, joint_data(1, 2)));
  run_suite(joint_subject("a on the ground", point_plane_type, joint_data(0, 2)));
  run_suite(joint_subject("b on the ground", point_plane_type, joint_data(2, 0)));
}

TEST(PointPlane, SuiteWithAllOptions) {
  JointData data = joint_data(1, 2);
  data.second = {{1, 0.5, 2}};
  run_coordinate(point_plane_type, data, slide_of, "SLIDE", false);
  run_coordinate(point_plane_type, data, slide_b_of, "SLIDE", false);
}

TEST(PointPlane, SuiteWithFriction) { run_friction(point_plane_type, joint_data(1, 2)); }
TEST(PointPlane, SuiteAtRestAndSliding) {
  JointData data = joint_data(1, 2);
  data.second = {{1, 0.5, 2}};  // the direction of sliding is kept in these axes
  run_grips(point_plane_type, data);
}

TEST(PointPlane, Extremes) { run_joint_extremes(point_plane_type, joint_data(1, 2)); }

TEST(PointPlane, AsksForNoRotationOfB) {
  JointData data = joint_data(1, 2);
  data.at.reset();
  const Subject s = joint_subject("at b", point_plane_type, data);
  run_suite(s);
  EXPECT_EQ(s.build(Mat3::Identity())->layout().needs[1], NodeNeed::translation);
}

TEST(PointPlane, SlidesAndTurnsFreely) {
  JointData data;
  data.axis = {0, 0, -1};
  JointAtOrigin joint(point_plane_type, data);
  joint.put({3, 4, 0}, {1, 2, 0.5});
  EXPECT_NEAR(joint.gaps()[0], 0, 1e-15);
  joint.put({3, 4, 0.25}, {1, 2, 0.5});
  EXPECT_NEAR(joint.gaps()[0], -0.25, 1e-15);
  joint.state.multipliers = {6};
  EXPECT_NEAR(joint.channel("FORCE_Z"), -6, 1e-14);
}

}  // namespace
}  // namespace engrane::elements::joints
