// SPDX-License-Identifier: BSD-3-Clause
#include "elements/control/coupling.hpp"

#include "elements/control/coordinate_cases.hpp"

namespace engrane::elements::control {
namespace {

using namespace suite;

CouplingData coupling(int i, int j) {
  CouplingData data;
  data.joints = {i, j};
  data.ratio = -1.7;
  data.offset = 12;
  return data;
}

/// Angle to slide, slide to angle, angles of a universal joint, joints that share a node, sensors.
std::vector<CouplingData> pairs() {
  std::vector<CouplingData> all = {coupling(1, 2), coupling(3, 3), coupling(4, 1), coupling(11, 12), coupling(13, 2)};
  all[0].first = "ANGLE";
  all[0].second = "SLIDE";
  all[1].first = "ANGLE_1";
  all[1].second = "ANGLE_2";
  all[2].first = "SLIDE";
  all[2].second = "ANGLE";
  return all;
}

TEST(Coupling, Suite) {
  for (const CouplingData& data : pairs())
    run_suite(machine_subject("rigid " + std::to_string(data.joints[0]), coupling_type, data));
}

TEST(Coupling, SuiteElastic) {
  for (CouplingData data : pairs()) {
    data.stiffness = 30;
    run_suite(machine_subject("spring " + std::to_string(data.joints[0]), coupling_type, data));
    data.damping = 2;
    run_suite(damped(machine_subject("damper " + std::to_string(data.joints[0]), coupling_type, data)));
  }
}

TEST(Coupling, Extremes) {
  for (CouplingData data : pairs())
    for (const double stiffness : {1e-6, 1e15}) {
      data.stiffness = data.damping = stiffness;
      run_extreme(machine_subject("extreme", coupling_type, data));
    }
}

/// Two shafts on the ground, the second three times as fast: the relation holds over thousands of turns, and efforts are in
/// the ratio of virtual work.
TEST(Coupling, ManyTurnsAndVirtualWork) {
  const NodeMap nodes = {{0, Vec3::Zero()}, {1, {1, 0, 0}}, {2, {2, 0, 0}}};
  const ElementType joint = cylindrical_type();
  JointData shaft;
  shaft.axis = {0, 0, 1};
  std::vector<deck::Record> records(2);
  for (int i = 0; i < 2; ++i) {
    shaft.nodes = {0, i + 1};
    records[static_cast<std::size_t>(i)].schema = &joint.schema;
    records[static_cast<std::size_t>(i)].id = i + 1;
    records[static_cast<std::size_t>(i)].data = shaft;
  }
  CouplingData data;
  data.joints = {1, 2};
  data.ratio = -3;
  data.offset = 90;
  data.first = data.second = "ANGLE";
  const auto element = build(coupling_type(), data, nodes, {.records = &records});
  StateBuffer state(*element, nodes);
  const double step = 0.7, offset = std::numbers::pi / 2;
  for (int k = 0; k <= 20000; ++k) {
    state.turn(1, rotation_exp(Vec3(0, 0, k * step)), Vec3::Zero());
    state.turn(2, rotation_exp(Vec3(0, 0, offset - 3 * k * step)), Vec3::Zero());
    if (k < 20000) state.commit(*element);
  }
  EXPECT_NEAR(channel_of(*element, state, "COORDINATE_1"), 14000, 1e-9);
  EXPECT_NEAR(channel_of(*element, state, "DIFFERENCE"), 0, 1e-9);
  state.multipliers[0] = 5;
  const auto r = residual_of(*element, state);
  EXPECT_NEAR(-r[6 + 5], 15, 1e-13) << "on the first shaft: -ratio times the multiplier";
  EXPECT_NEAR(-r[12 + 5], 5, 1e-13) << "on the second";
  EXPECT_NEAR(channel_of(*element, state, "EFFORT_1"), 15, 1e-13);
}

TEST(Coupling, FaultsOfTheCard) {
  EXPECT_EQ(machine_fault(coupling_type, coupling(1, 9)), "element 9 does not exist");
  EXPECT_EQ(machine_fault(coupling_type, coupling(1, 5)), "SPHERICAL 5 has no coordinate");
  EXPECT_EQ(machine_fault(coupling_type, coupling(1, 1)), "SLIDE of element 1 is coupled to itself");
  CouplingData data = coupling(1, 2);
  data.second = "ANGLE";
  EXPECT_EQ(machine_fault(coupling_type, data), "PRISMATIC 2 has no coordinate ANGLE");
}

}  // namespace
}  // namespace engrane::elements::control
