// SPDX-License-Identifier: BSD-3-Clause
// What the tests of all joints share: nodes apart, an axis and a joint point off both, drives, and what must stay finite.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "elements/grip_states.hpp"
#include "elements/joints/joint_card.hpp"
#include "elements/suite.hpp"
#include "math/rotation.hpp"

namespace engrane::suite {

using namespace elements::joints;

inline std::array<double, 3> components(const Vec3& v) { return {v[0], v[1], v[2]}; }

/// Function 1 of the tests: a wave about a mean, so that nothing is zero by chance.
const FunctionMap& joint_functions();

/// Nodes 1 and 2, the joint point off both.
JointData joint_data(int a, int b);

/// Turns B's rotation from A back to at most `largest`: joints have no meaning with axes reversed, and half a turn from what was
/// last accepted is the next turn.
void keep_near(StateBuffer& state, double largest);

Subject joint_subject(const std::string& name, ElementType (*type)(), const JointData& wished);

/// A damper has no potential.
Subject damped(Subject s);

Subject driven(Subject s);

/// The free coordinate of a card that a test speaks of.
using Coordinate = CoordinateData& (*)(JointData&);
inline CoordinateData& slide_of(JointData& data) { return data.slide(); }
inline CoordinateData& slide_b_of(JointData& data) { return data.slide_b(); }
inline CoordinateData& turn_of(JointData& data) { return data.turn(); }
inline CoordinateData& turn_b_of(JointData& data) { return data.turn_b(); }

/// Values and rates of the switches against differences along the motion.
void check_switches(const Subject& subject);

/// Drives, springs by every law, and stops of one free coordinate; `drives` names the options of its drive.
void run_coordinate(ElementType (*type)(), const JointData& plain, Coordinate of, const std::string& itself, bool turns,
                    double largest = 2);

/// Friction by every law, below and above the speed at which it is regularised. Sums, objectivity, tangent and power are the
/// suite's; here that the power is lost, and no more than there is friction.
void run_friction(ElementType (*type)(), const JointData& plain, bool has_radius = true, double largest = 2);

/// Friction that can rest (STICK): sliding in any direction, where its multipliers are zero, and held. `skip`: what these states
/// do not fulfil, with the reason.
void run_grips(ElementType (*type)(), const JointData& plain, bool has_radius = true,
               const std::map<Check, std::string>& skip = {}, double largest = 2);

/// Long and short, with any stiffness, through 1e6 turns.
void run_joint_extremes(ElementType (*type)(), const JointData& wished);

/// The first message about a faulty card.
std::string joint_fault(ElementType (*type)(), const JointData& data);

/// A joint of node 1 on the ground, both at the origin, with multipliers set by hand: forces and moments in joint axes.
struct JointAtOrigin {
  JointAtOrigin(ElementType (*type)(), JointData data)
      : joint(build(type(), at_origin(std::move(data)), nodes, {.functions = &joint_functions()})), state(*joint, nodes) {}
  static JointData at_origin(JointData data) {
    data.nodes = {0, 1};
    data.at = {{0, 0, 0}};
    return data;
  }
  /// Moves node 1 to x, turned by a rotation vector.
  void put(const Vec3& x, const Vec3& turn) {
    state.nodes[1].x = x;
    state.turn(1, rotation_exp(turn), Vec3::Zero());
  }
  /// Velocity and spin of node 1, global; call it after put().
  void move(const Vec3& velocity, const Vec3& spin) {
    state.nodes[1].v = velocity;
    state.nodes[1].W = state.nodes[1].R.transpose() * spin;
  }
  /// Values of the constraints.
  std::vector<double> gaps() const {
    const auto r = residual_of(*joint, state);
    std::vector<double> phi(r.begin() + 12, r.end());
    for (double& value : phi) value = -value;
    return phi;
  }
  double channel(const std::string& name) const { return channel_of(*joint, state, name); }
  void accept() { state.commit(*joint); }

  NodeMap nodes = {{0, Vec3::Zero()}, {1, Vec3::Zero()}};
  std::unique_ptr<Element> joint;
  StateBuffer state;
};

}  // namespace engrane::suite
