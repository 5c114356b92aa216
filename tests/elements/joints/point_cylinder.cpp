// SPDX-License-Identifier: BSD-3-Clause
#include "elements/joints/point_cylinder.hpp"

#include "elements/joints/joint_cases.hpp"

namespace engrane::elements::joints {
namespace {

using namespace suite;

JointData cylinder(int a, int b) {
  JointData data = joint_data(a, b);
  data.on = {{3.1, -2.4, 0.7}};  // far off, so that no state comes near the axis
  return data;
}

TEST(PointCylinder, Suite) {
  run_suite(joint_subject("joint", point_cylinder_type, cylinder(1, 2)));
  run_suite(joint_subject("a on the ground", point_cylinder_type, cylinder(0, 2)));
  run_suite(joint_subject("b on the ground", point_cylinder_type, cylinder(2, 0)));
  JointData data = cylinder(1, 2);
  data.at.reset();
  const Subject s = joint_subject("at node b", point_cylinder_type, data);
  run_suite(s);
  EXPECT_EQ(s.build(Mat3::Identity())->layout().needs[1], NodeNeed::translation);
}

TEST(PointCylinder, SuiteWithAllOptions) {
  run_coordinate(point_cylinder_type, cylinder(1, 2), slide_of, "SLIDE", false);
  run_coordinate(point_cylinder_type, cylinder(1, 2), turn_of, "ANGLE", true);
}

TEST(PointCylinder, SuiteWithFriction) {
  JointData data = cylinder(1, 2);
  run_friction(point_cylinder_type, data, false);
}

TEST(PointCylinder, SuiteAtRestAndSliding) { run_grips(point_cylinder_type, cylinder(1, 2), false); }

TEST(PointCylinder, Extremes) { run_joint_extremes(point_cylinder_type, cylinder(1, 2)); }

/// A point on the cylinder of radius 2 about z, at x = 2 in the reference configuration.
struct OnCylinder {
  explicit OnCylinder(JointData data = {}) {
    data.nodes = {0, 1};
    data.axis = {0, 0, 3};
    joint = build(point_cylinder_type(), data, nodes);
    state = std::make_unique<StateBuffer>(*joint, nodes);
  }
  double channel(const std::string& name) const { return channel_of(*joint, *state, name); }
  NodeMap nodes = {{0, Vec3::Zero()}, {1, {2, 0, 0.5}}};
  std::unique_ptr<Element> joint;
  std::unique_ptr<StateBuffer> state;
};

TEST(PointCylinder, SlidesAndTurnsOnTheSurface) {
  OnCylinder on;
  for (int i = 1; i <= 300; ++i) {
    const double angle = 2 * i;
    on.state->nodes[1].x = {2 * std::cos(angle), 2 * std::sin(angle), 0.5 + 0.01 * i};
    on.state->commit(*on.joint);
  }
  EXPECT_NEAR(residual_of(*on.joint, *on.state).back(), 0, 1e-14);
  EXPECT_NEAR(on.channel("ANGLE"), 600, 1e-11) << "turns are counted";
  EXPECT_NEAR(on.channel("SLIDE"), 3, 1e-14);
  on.state->nodes[1].x = {0, 2.25, 0};
  EXPECT_NEAR(-residual_of(*on.joint, *on.state).back(), 0.25, 1e-15);
  on.state->multipliers = {7};
  EXPECT_NEAR(on.channel("FORCE_Y"), 7, 1e-14) << "away from the axis";
  EXPECT_NEAR(on.channel("NORMAL_FORCE"), 7, 1e-15);
}

TEST(PointCylinder, FrictionAgainstTheSlidingVelocity) {
  JointData data;
  data.friction = {"CONST", {0.25}};
  data.friction_width = 1e-3;
  OnCylinder on(data);
  on.state->nodes[1].v = {5, 4, 3};  // 5 is off the surface and does not slide
  on.state->multipliers = {-8};
  EXPECT_NEAR(on.channel("FORCE_Y"), -2 * 0.8, 1e-13);
  EXPECT_NEAR(on.channel("FORCE_Z"), -2 * 0.6, 1e-13);
  EXPECT_NEAR(on.channel("FRICTION_FORCE"), 2, 1e-13);
  EXPECT_NEAR(on.channel("FRICTION_POWER"), 10, 1e-12);
}

TEST(PointCylinder, FrictionAtRestIsOfTheSurface) {
  JointData data;
  data.friction = {"CONST", {0.25}};
  OnCylinder on(data);
  const Layout& layout = on.joint->layout();
  std::vector<Grip> grips(1);
  on.state->nodes[1].v = {5, 4, 3};
  find_grips(*on.joint, on.state->view(), grips);
  EXPECT_LT((grips[0].speed - Vec3(3, 4, 0)).norm(), 1e-14) << "along the axis, and around it";
  GripState::slides_towards(grips[0].speed, Vec3::Zero()).write(layout, on.state->history, 0);
  on.state->multipliers = {-8, 0, 0};
  EXPECT_NEAR(on.channel("FORCE_X"), -8, 1e-13);
  EXPECT_NEAR(on.channel("FORCE_Y"), -2 * 0.8, 1e-13);
  EXPECT_NEAR(on.channel("FORCE_Z"), -2 * 0.6, 1e-13);
  GripState::holds_at(Vec3::Zero()).write(layout, on.state->history, 0);
  on.state->multipliers = {-8, 0.5, 3};
  EXPECT_NEAR(on.channel("FORCE_X"), -8, 1e-13);
  EXPECT_NEAR(on.channel("FORCE_Y"), 1.5, 1e-13) << "a moment of 3 at the radius 2";
  EXPECT_NEAR(on.channel("FORCE_Z"), 0.5, 1e-13);
}

TEST(PointCylinder, FaultsOfTheCard) {
  JointData data;
  data.nodes = {0, 2};
  data.axis = {1, 3, 4};
  EXPECT_EQ(joint_fault(point_cylinder_type, data), "the point is on the axis of the cylinder");
}

}  // namespace
}  // namespace engrane::elements::joints
