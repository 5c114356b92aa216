// SPDX-License-Identifier: BSD-3-Clause
// What the tests of all joints share: nodes apart, an axis and a joint point off both, drives, and what must stay finite.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "elements/joint_card.hpp"
#include "math/rotation.hpp"
#include "suite.hpp"

namespace engrane::suite {

inline std::array<double, 3> components(const Vec3& v) { return {v[0], v[1], v[2]}; }

/// Function 1 of the tests: a wave about a mean, so that nothing is zero by chance.
inline const FunctionMap& joint_functions() {
  static const FunctionMap functions = [] {
    FunctionMap f;
    f[1] = std::make_unique<Wave>(0.3, 0.7, 1.9, 0.4);
    return f;
  }();
  return functions;
}

/// Nodes 1 and 2, the joint point off both.
inline JointData joint_data(int a, int b) {
  JointData data;
  data.nodes = {a, b};
  data.axis = {0.3, -0.5, 0.7};
  data.at = {{0.4, 0.1, -0.2}};
  data.pitch = 0.8;
  return data;
}

inline Subject joint_subject(const std::string& name, ElementType (*type)(), const JointData& wished) {
  Subject s;
  s.name = name;
  s.nodes = {{0, Vec3::Zero()}, {1, {1, 0.2, -0.3}}, {2, {-0.5, 0.4, 0.8}}};
  s.build = [=](const Mat3& Q) {
    JointData data = wished;
    data.axis = components(Q * Vec3(data.axis.data()));
    for (auto* direction : {&data.second, &data.at, &data.from, &data.to})
      if (*direction) *direction = components(Q * Vec3((*direction)->data()));
    return build(type(), data, turned(s.nodes, Q), {.functions = &joint_functions()});
  };
  s.force = 5;
  s.own_axes = true;
  return s;
}

/// A damper has no potential.
inline Subject damped(Subject s) {
  s.skip[Check::lagrange] = "a damper has no potential";
  return s;
}

inline Subject driven(Subject s) {
  s.skip[Check::zero] = "the function is not zero at t = 0";
  s.skip[Check::rigid] = "the function is not zero at t = 0";
  return s;
}

/// Long and short, with any stiffness, through 1e6 turns.
inline void run_joint_extremes(ElementType (*type)(), const JointData& wished) {
  for (const double stiffness : {1e-6, 1e15})
    for (const double length : {1e-9, 1e6}) {
      Subject s;
      s.name = "stiffness " + std::to_string(stiffness) + " length " + std::to_string(length);
      s.nodes = {{0, Vec3::Zero()}, {1, Vec3(length, 0, 0)}, {2, Vec3(0, length, 0)}};
      s.length = s.velocity = length;
      s.build = [=](const Mat3&) {
        JointData data = wished;
        data.stiffness = data.damping = data.turn_stiffness = data.turn_damping = stiffness;
        data.pitch *= length;
        for (auto* place : {&data.at, &data.from, &data.to})
          if (*place) *place = components(Vec3((*place)->data()) * length);
        return build(type(), data, s.nodes, {.functions = &joint_functions()});
      };
      run_extreme(s);
    }
}

/// The first message about a faulty card.
inline std::string joint_fault(ElementType (*type)(), const JointData& data) {
  const NodeMap nodes = {{0, Vec3::Zero()}, {1, {1, 0, 0}}, {2, {1, 3, 4}}};
  Diagnostics diagnostics;
  EXPECT_EQ(build(type(), data, nodes, {.functions = &joint_functions(), .diagnostics = &diagnostics}), nullptr);
  return diagnostics.all().empty() ? std::string() : diagnostics.all().front().message;
}

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
  /// Values of the constraints.
  std::vector<double> gaps() const {
    const auto r = residual_of(*joint, state);
    std::vector<double> phi(r.begin() + 12, r.end());
    for (double& value : phi) value = -value;
    return phi;
  }
  double channel(const std::string& name) const { return channel_of(*joint, state, name); }
  void accept() {
    std::vector<double> history = state.history;
    joint->commit(state.view(), {}, history);
    state.history = history;
  }

  NodeMap nodes = {{0, Vec3::Zero()}, {1, Vec3::Zero()}};
  std::unique_ptr<Element> joint;
  StateBuffer state;
};

}  // namespace engrane::suite
