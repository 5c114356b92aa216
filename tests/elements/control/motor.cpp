// SPDX-License-Identifier: BSD-3-Clause
#include "elements/control/motor.hpp"

#include <array>

#include "elements/control/coordinate_cases.hpp"

namespace engrane::elements::control {
namespace {

using namespace suite;

MotorData motor(int joint, const char* coordinate) {
  MotorData data;
  data.joint = joint;
  data.coordinate = coordinate;
  data.curve = 1;
  data.ratio = -2.5;
  return data;
}

/// Angles and slides, joints that share no node with the ground and one that does, a sensor.
std::vector<MotorData> motors() {
  std::vector<MotorData> all = {motor(1, "ANGLE"), motor(2, "SLIDE"), motor(3, "ANGLE_2"), motor(4, "SLIDE"), motor(12, "")};
  all[0].function = 1;
  all[1].curve = 0;
  all[1].stall = 7;
  all[1].free = 3;
  return all;
}

TEST(Motor, Suite) {
  for (const MotorData& data : motors())
    run_suite(damped(machine_subject("motor on " + std::to_string(data.joint), motor_type, data)));
}

TEST(Motor, Extremes) {
  for (MotorData data : motors()) {
    data.curve = 0;
    data.stall = 1e15;
    data.free = 1e-6;
    run_extreme(machine_subject("extreme", motor_type, data));
  }
}

/// Joint 1 of this type between the ground and node 1, about the third axis.
std::vector<deck::Record> shaft_on_ground(const ElementType& joint) {
  JointData shaft;
  shaft.nodes = {0, 1};
  shaft.axis = {0, 0, 1};
  std::vector<deck::Record> records(1);
  records[0].schema = &joint.schema;
  records[0].id = 1;
  records[0].data = shaft;
  return records;
}

/// A shaft that turns three times as fast as the joint: its speed, the curve's torque there, and the slope as damping.
TEST(Motor, FollowsItsCurve) {
  const NodeMap nodes = {{0, Vec3::Zero()}, {1, {1, 0, 0}}};
  const ElementType joint = cylindrical_type();
  const std::vector<deck::Record> records = shaft_on_ground(joint);
  MotorData data = motor(1, "ANGLE");
  data.curve = 0;
  data.stall = 8;
  data.free = 300;
  data.ratio = 3;
  const auto element = build(motor_type(), data, nodes, {.records = &records});
  StateBuffer state(*element, nodes);
  for (const double speed : {-10.0, 0.0, 25.0, 100.0, 120.0}) {
    state.nodes[1].W = {0, 0, speed};
    const double torque = 8 * (1 - 3 * speed / 300);
    EXPECT_NEAR(channel_of(*element, state, "SPEED"), 3 * speed, 1e-12);
    EXPECT_NEAR(channel_of(*element, state, "TORQUE"), torque, 1e-12);
    EXPECT_NEAR(channel_of(*element, state, "EFFORT"), 3 * torque, 1e-12);
    EXPECT_NEAR(channel_of(*element, state, "POWER"), 3 * torque * speed, 1e-10);
    EXPECT_NEAR(element->energies(state.view()).external, 3 * torque * speed, 1e-10);
    const std::vector<double> r = residual_of(*element, state);
    EXPECT_NEAR(r[11], -3 * torque, 1e-12) << "it pushes the joint's angle up: what resists is the opposite";
    EXPECT_NEAR(r[5], 3 * torque, 1e-12);
    const std::vector<double> c = tangent_of(*element, state, {0, 1, 0, 0});
    EXPECT_NEAR(c[11 * r.size() + 11], 9 * 8 / 300.0, 1e-12) << "the slope damps with the square of the ratio";
  }
}

/// A formula with a corner at the shaft's speed 6: the switch and its rate.
TEST(Motor, PassesTheCornerOfItsCurve) {
  const NodeMap nodes = {{0, Vec3::Zero()}, {1, {1, 0, 0}}};
  const ElementType joint = cylindrical_type();
  const std::vector<deck::Record> records = shaft_on_ground(joint);
  deck::FunctionCard card;
  card.expression = "MAX(0, 6 - X)";
  deck::Record record;
  record.id = 1;
  record.data = card;
  Diagnostics diagnostics;
  FunctionMap functions;
  functions[1] = make_function(record, diagnostics);
  ASSERT_TRUE(diagnostics.all().empty());
  const auto element = build(motor_type(), motor(1, "ANGLE"), nodes, {.functions = &functions, .records = &records});
  ASSERT_EQ(element->layout().switches.size(), 1u);
  EXPECT_FALSE(element->has_gaps()) << "statics bridges gaps, and a motor has none";
  StateBuffer state(*element, nodes);
  state.nodes[1].W = {0, 0, -3};  // the shaft turns -2.5 times as fast
  state.nodes[1].A = {0, 0, 0.4};
  std::array<Switch, 1> corner;
  element->switches(state.view(), corner);
  EXPECT_NEAR(corner[0].value, 0 - (6 - 7.5), 1e-12);
  EXPECT_NEAR(corner[0].rate, -2.5 * 0.4, 1e-12);
}

TEST(Motor, FaultsOfTheCard) {
  MotorData data = motor(1, "ANGLE");
  data.curve = 0;
  EXPECT_EQ(machine_fault(motor_type, data), "a motor needs its torque as a function of its speed");
  data.stall = 3;
  EXPECT_EQ(machine_fault(motor_type, data), "a motor needs its torque as a function of its speed");
  data.free = 5;
  data.curve = 1;
  EXPECT_EQ(machine_fault(motor_type, data), "CURVE and STALL with FREE both give the torque");
  data = motor(1, "ANGLE");
  data.ratio = 0;
  EXPECT_EQ(machine_fault(motor_type, data), "RATIO 0 takes the motor off its joint");
  EXPECT_EQ(machine_fault(motor_type, motor(1, "TWIST")), "CYLINDRICAL 1 has no coordinate TWIST");
  EXPECT_EQ(machine_fault(motor_type, motor(77, "")), "element 77 does not exist");
}

}  // namespace
}  // namespace engrane::elements::control
