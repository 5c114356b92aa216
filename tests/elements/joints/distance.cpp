// SPDX-License-Identifier: BSD-3-Clause
#include "elements/joints/distance.hpp"

#include "elements/joints/joint_cases.hpp"

namespace engrane::elements::joints {
namespace {

using namespace suite;

JointData rod(int a, int b) {
  JointData data;
  data.nodes = {a, b};
  data.from = {{0.4, 0.1, -0.2}};
  data.to = {{-0.3, 0.7, 5.5}};
  return data;
}

TEST(Distance, Suite) {
  run_suite(joint_subject("rod", distance_type, rod(1, 2)));
  run_suite(joint_subject("on the ground", distance_type, rod(0, 2)));
  JointData data = rod(1, 2);
  data.from.reset();
  data.to.reset();
  const Subject s = joint_subject("between nodes", distance_type, data);
  run_suite(s);
  EXPECT_EQ(s.build(Mat3::Identity())->layout().needs[0], NodeNeed::translation);
}

TEST(Distance, SuiteWithDrive) {
  for (const char* kind : {"LENGTH", "SPEED"}) {
    JointData data = rod(1, 2);
    data.slide().drive.tag = kind;
    data.slide().function = 1;
    run_suite(driven(joint_subject(std::string("driven in ") + kind, distance_type, data)));
  }
}

TEST(Distance, SuiteWithAllOptions) { run_coordinate(distance_type, rod(1, 2), slide_of, "LENGTH", false); }

TEST(Distance, Extremes) { run_joint_extremes(distance_type, rod(1, 2)); }

TEST(Distance, PushesAlongItself) {
  JointData data;
  data.nodes = {0, 1};
  data.from = {{0, 0, 0}};
  const NodeMap nodes = {{0, Vec3::Zero()}, {1, {0, 3, 4}}};
  const auto joint = build(distance_type(), data, nodes);
  StateBuffer state(*joint, nodes);
  state.multipliers = {10};
  EXPECT_NEAR(channel_of(*joint, state, "LENGTH"), 5, 1e-15);
  EXPECT_NEAR(channel_of(*joint, state, "FORCE_Y"), 6, 1e-14);
  EXPECT_NEAR(channel_of(*joint, state, "FORCE_Z"), 8, 1e-14);
  EXPECT_NEAR(channel_of(*joint, state, "THRUST"), 10, 1e-14);
}

TEST(Distance, IsFreeButForSpringAndStops) {
  JointData data;
  data.nodes = {0, 1};
  data.from = {{0, 0, 0}};
  data.slide().stiffness = 10;
  data.slide().upper = 5.5;
  data.slide().stop_stiffness = 100;
  const NodeMap nodes = {{0, Vec3::Zero()}, {1, {0, 3, 4}}};
  const auto joint = build(distance_type(), data, nodes);
  StateBuffer state(*joint, nodes);
  EXPECT_TRUE(joint->layout().multipliers.empty());
  EXPECT_NEAR(channel_of(*joint, state, "THRUST"), 0, 1e-14);
  state.nodes[1].x *= 1.2;
  EXPECT_NEAR(channel_of(*joint, state, "LENGTH_SPRING"), -10, 1e-13);
  EXPECT_NEAR(channel_of(*joint, state, "LENGTH_STOP"), -50, 1e-12);
  EXPECT_NEAR(channel_of(*joint, state, "THRUST"), -60, 1e-12);
}

TEST(Distance, FaultsOfTheCard) {
  JointData data;
  data.nodes = {0, 1};
  EXPECT_EQ(joint_fault(distance_type, data), "the ground has no place");
  data.from = {{1, 0, 0}};
  EXPECT_EQ(joint_fault(distance_type, data), "both ends of the rod are in one place");
}

}  // namespace
}  // namespace engrane::elements::joints
