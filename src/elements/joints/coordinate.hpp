// SPDX-License-Identifier: BSD-3-Clause
// A scalar coordinate between two nodes, for use by other elements.
#pragma once

#include <array>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "elements/joints/joint_measures.hpp"
#include "model/coordinate_channels.hpp"
#include "model/templated_element.hpp"

namespace engrane::elements::joints {

struct Coordinate {
  std::string name;            ///< the element's channel: ANGLE, SLIDE
  std::array<int, 2> nodes{};  ///< a and b
  JointFrame frame;
  Measure what = Measure::angle;
  Vec3 point = Vec3::Zero();  ///< for drawings

  bool is_angle() const { return is_turn(what); }
  Dimension dimension() const { return is_angle() ? dimension::angle : dimension::length; }
  Dimension rate_dimension() const { return is_angle() ? dimension::angular_velocity : dimension::velocity; }
  Dimension effort_dimension() const { return is_angle() ? dimension::moment : dimension::force; }
  int history() const { return is_angle() ? turn_count::history : 0; }
  NodeNeed need(std::size_t end) const {
    return (end == 0 ? frame.turns_a : frame.turns_b) ? NodeNeed::both : NodeNeed::translation;
  }

  /// Value, gradient and rate. `committed` is the part of the element's history that counts the turns.
  template <class T>
  struct Reading {
    JointPose<T> pose;
    Measured<T> measured;
    T rate;
  };
  template <class T, class Node>
  Reading<T> read(const Node& a, const Node& b, std::span<const double> committed) const {
    const JointPose<T> pose(frame, a, b);
    Measured<T> m = measure(what, frame, pose);
    if (is_angle()) m.value += 2 * std::numbers::pi * turn_count::turns(value_of(m.value), committed);
    const auto spin = [](bool turning, const Node& node) {
      return turning ? Vec3T<T>(rotate(node.R, node.W)) : Vec3T<T>(T(0), T(0), T(0));
    };
    const Vec3T<T> spin_a = spin(frame.turns_a, a), spin_b = spin(frame.turns_b, b);
    const Vec3T<T> slip = b.v + cross(spin_b, pose.arm_b) - a.v - cross(spin_a, Vec3T<T>(pose.arm_a + pose.gap));
    return {pose, m, dot(m.force, slip) + dot(m.moment, Vec3T<T>(spin_b - spin_a))};
  }

  /// Applies an effort along the coordinate to nodes `ia` and `ib` of the element: a force for a length, a moment for an angle,
  /// positive in the direction in which the coordinate grows. The forces and moments on the two nodes balance.
  template <class T, class Node, int Nodes>
  void act(const Reading<T>& reading, const T& effort, const Node& a, const Node& b, int ia, int ib,
           Balance<T, Nodes>& balance) const {
    const Vec3T<T> force = reading.measured.force * effort, moment = reading.measured.moment * effort;
    const JointPose<T>& pose = reading.pose;
    balance.force(ia, force);
    balance.force(ib, Vec3T<T>(-force));
    if (frame.turns_a) balance.moment(ia, rotate_back(a.R, Vec3T<T>(cross(Vec3T<T>(pose.gap + pose.arm_a), force) + moment)));
    if (frame.turns_b) balance.moment(ib, rotate_back(b.R, Vec3T<T>(-cross(pose.arm_b, force) - moment)));
  }

  /// Writes the turn count that the next step starts from.
  void commit(const NodeState& a, const NodeState& b, std::span<const double> committed, std::span<double> next) const;
};

/// An element whose coordinates other elements can couple, measure and actuate.
class CoordinateOwner : public CoordinateChannels {
 public:
  virtual std::vector<Coordinate> coordinates() const = 0;
  int coordinate_count() const override { return static_cast<int>(coordinates().size()); }

 protected:
  ~CoordinateOwner() = default;
};

}  // namespace engrane::elements::joints
