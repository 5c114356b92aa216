// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <vector>

#include "elements/drive.hpp"
#include "elements/joint_measures.hpp"
#include "model/templated_element.hpp"

namespace engrane {

/// A measure that the joint holds at a value.
struct JointConstraint {
  Measure measure;
  double value = 0;
};

/// A measure left free: it is observed, and may have a spring, a damper and a drive.
struct JointCoordinate {
  Measure measure;
  std::string name, rate_name;  ///< channels: SLIDE, SLIDE_SPEED
  double stiffness = 0, damping = 0, relaxed = 0;
  Drive drive = {};
  double origin = 0;  ///< value at t = 0 when the drive gives the rate

  bool sprung() const { return stiffness > 0 || damping > 0; }
};

/// What a kind of joint is made of.
struct JointParts {
  JointFrame frame;
  std::array<int, 2> nodes{};
  std::vector<JointConstraint> constraints;
  std::vector<JointCoordinate> coordinates;
  bool has_axis = true;       ///< reports reactions along e1, e2, e3 too
  bool drawn_axis = true;     ///< drawn with its axis e1
  bool is_bearing = false;    ///< reports the sizes of force and moment across the axis
  bool has_thrust = false;    ///< reports the force along the gap
  bool has_moment = true;     ///< reports moments
  Vec3 point = Vec3::Zero();  ///< joint point, for pictures
};

/// Any joint between two nodes that is a list of constraints and free coordinates (joint_measures.hpp). The multipliers
/// are forces and moments on B in the joint axes that A carries.
class Joint final : public TemplatedElement<Joint, 2, 18> {
 public:
  Joint(int id, JointParts parts);

  template <class T>
  void evaluate(const Motion<T, 2>& motion, const State& state, Balance<T, 2>& balance) const {
    const auto& a = motion.node[0];
    const auto& b = motion.node[1];
    const JointFrame& frame = parts_.frame;
    const JointPose<T> pose(frame, a, b);
    Vec3T<T> force(T(0), T(0), T(0)), moment(T(0), T(0), T(0));
    const auto add = [&](const Measured<T>& m, const T& amount) {
      force += m.force * amount;
      moment += m.moment * amount;
    };

    int row = 0;
    for (const JointConstraint& c : parts_.constraints) {
      const Measured<T> m = measured(c.measure, pose, state);
      add(m, balance.constraint(row++, m.value - c.value));
    }
    for (const JointCoordinate& c : parts_.coordinates) {
      if (!c.sprung() && !c.drive.given()) continue;
      const Measured<T> m = measured(c.measure, pose, state);
      if (c.drive.given()) add(m, balance.constraint(row++, m.value - c.drive.coordinate(motion.time) - driven_origin(c)));
      if (c.sprung()) add(m, T(-c.stiffness * (m.value - c.relaxed) - c.damping * rate(m, pose, a, b)));
    }

    balance.force(0, force);
    balance.force(1, Vec3T<T>(-force));
    // A's lever reaches to B's point, gap or no gap, so that the sum of moments is zero
    if (frame.turns_a) balance.moment(0, rotate_back(a.R, Vec3T<T>(cross(Vec3T<T>(pose.gap + pose.arm_a), force) + moment)));
    if (frame.turns_b) balance.moment(1, rotate_back(b.R, Vec3T<T>(-cross(pose.arm_b, force) - moment)));
  }

  void commit(const State& state, std::span<double> scalars, std::span<double> history) const override;
  Energies energies(const State& state) const override;
  const std::vector<Named>& channels() const override { return channels_; }
  void observe(const State& state, std::span<double> values) const override;
  Drawing drawing() const override;

  /// For elements that act on the joint's coordinates (joint_coordinate.hpp).
  const JointParts& parts() const { return parts_; }

 private:
  static double driven_origin(const JointCoordinate& c) { return c.drive.rate_given ? c.origin : 0; }

  /// Entry of an angle's turn count in the history, or -1.
  int counted(Measure what) const;

  template <class T>
  Measured<T> measured(Measure what, const JointPose<T>& pose, const State& state) const {
    const int at = counted(what);
    if (at < 0) return measure(what, parts_.frame, pose, 0);
    const auto committed = state.history.subspan(static_cast<std::size_t>(at), turn_count::history);
    const double angle = value_of(measure(what == Measure::screw ? Measure::angle : what, parts_.frame, pose, 0).value);
    return measure(what, parts_.frame, pose, turn_count::turns(angle, committed));
  }

  /// Rate of a measure from the velocities of the nodes, by its gradient.
  template <class T, class Node>
  T rate(const Measured<T>& m, const JointPose<T>& pose, const Node& a, const Node& b) const {
    const auto spin = [](bool turns, const Node& node) {
      return turns ? Vec3T<T>(rotate(node.R, node.W)) : Vec3T<T>(T(0), T(0), T(0));
    };
    const Vec3T<T> spin_a = spin(parts_.frame.turns_a, a), spin_b = spin(parts_.frame.turns_b, b);
    const Vec3T<T> slip = b.v + cross(spin_b, pose.arm_b) - a.v - cross(spin_a, Vec3T<T>(pose.arm_a + pose.gap));
    return dot(m.force, slip) + dot(m.moment, Vec3T<T>(spin_b - spin_a));
  }

  struct Observed {
    double value, rate;
  };
  Observed observed(const JointCoordinate& c, const State& state) const;
  void name_channels();

  JointParts parts_;
  std::vector<Measure> angles_;  ///< counted in turns, in the order of the history
  std::vector<Named> channels_;
};

}  // namespace engrane
