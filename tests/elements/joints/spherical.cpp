// SPDX-License-Identifier: BSD-3-Clause
#include "elements/joints/spherical.hpp"

#include "elements/joints/joint_cases.hpp"

namespace engrane::elements::joints {
namespace {

using namespace suite;

TEST(Spherical, Suite) {
  run_suite(joint_subject("joint", spherical_type, joint_data(1, 2)));
  run_suite(joint_subject("a on the ground", spherical_type, joint_data(0, 2)));
  run_suite(joint_subject("b on the ground", spherical_type, joint_data(2, 0)));
}

TEST(Spherical, SuiteWithFriction) { run_friction(spherical_type, joint_data(1, 2)); }
TEST(Spherical, SuiteAtRestAndSliding) {
  run_grips(spherical_type, joint_data(1, 2), true,
            {{Check::rotated_copy, "directions of sliding are kept in axes that it has not"}});
}

TEST(Spherical, FrictionAgainstTheSpin) {
  JointData data;
  data.friction = {"CONST", {0.2}};
  data.friction_width = 1e-3;
  data.radius = 0.1;
  JointAtOrigin joint(spherical_type, data);
  joint.put(Vec3::Zero(), {1, 2, 3});
  joint.move(Vec3::Zero(), {6, -2, 3});
  joint.state.multipliers = {1, 2, -2};
  const auto r = residual_of(*joint.joint, joint.state);
  const Vec3 moment = -joint.state.nodes[1].R * Vec3(r[9], r[10], r[11]);
  EXPECT_NEAR((moment - Vec3(-6, 2, -3) / 7 * 0.2 * 0.1 * 3).norm(), 0, 1e-15);
  EXPECT_NEAR(joint.channel("FRICTION_MOMENT"), 0.06, 1e-15);
  EXPECT_NEAR(joint.channel("FRICTION_POWER"), 0.42, 1e-14);
}

TEST(Spherical, Extremes) { run_joint_extremes(spherical_type, joint_data(1, 2)); }

TEST(Spherical, AsksForNoRotationItDoesNotNeed) {
  JointData data;
  data.nodes = {0, 2};
  Subject s = joint_subject("at b", spherical_type, data);
  run_suite(s);
  EXPECT_EQ(s.build(Mat3::Identity())->layout().needs[1], NodeNeed::translation);
  data.nodes = {1, 2};
  data.at = components(s.nodes.at(1));
  s = joint_subject("at a", spherical_type, data);
  s.skip[Check::objectivity] = "the multipliers are along global axes, which do not turn";
  s.skip[Check::equilibrium] = "across an open gap the forces are a couple, which no rotation of a balances";
  s.skip[Check::rotated_copy] = "along global axes";
  run_suite(s);
  EXPECT_EQ(s.build(Mat3::Identity())->layout().needs[0], NodeNeed::translation);
  EXPECT_EQ(s.build(Mat3::Identity())->layout().needs[1], NodeNeed::both);
}

TEST(Spherical, TurnsFreely) {
  JointAtOrigin joint(spherical_type, JointData{});
  joint.put(Vec3::Zero(), {1, 2, -2.5});
  joint.state.multipliers = {2, 3, 6};
  for (const double gap : joint.gaps()) EXPECT_EQ(gap, 0);
  EXPECT_NEAR(joint.channel("FORCE_Z"), 6, 1e-14);
  EXPECT_NEAR(joint.channel("FORCE_SIZE"), 7, 1e-14);
}

TEST(Spherical, FaultsOfTheCard) {
  JointData data;
  data.nodes = {1, 2};
  EXPECT_EQ(joint_fault(spherical_type, data), "nodes 1 and 2 of the spherical joint are 5 apart");
}

}  // namespace
}  // namespace engrane::elements::joints
