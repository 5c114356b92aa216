// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <vector>

#include "elements/common/drive.hpp"
#include "elements/common/spring_law.hpp"
#include "elements/common/stop_range.hpp"
#include "elements/joints/coordinate.hpp"
#include "elements/joints/joint_friction.hpp"
#include "elements/joints/joint_measures.hpp"
#include "model/templated_element.hpp"

namespace engrane::elements::joints {

/// A measure that the joint holds at a value.
struct JointConstraint {
  Measure measure;
  double value = 0;
};

/// The channels of a free coordinate.
struct CoordinateNames {
  std::string value, rate;                      ///< SLIDE, SLIDE_SPEED
  std::string spring, drive, power, stop, gap;  ///< SLIDE_SPRING and so on

  static CoordinateNames of(const std::string& value, const std::string& rate) {
    return {value, rate, value + "_SPRING", value + "_DRIVE", value + "_POWER", value + "_STOP", value + "_GAP"};
  }
};

/// A measure left free: it is observed, and may have a spring, a damper, a drive and stops.
struct JointCoordinate {
  Measure measure;
  CoordinateNames names;
  SpringLaw law = {};
  double relaxed = 0;  ///< where the spring is
  Drive drive = {};
  double origin = 0;  ///< value at t = 0 when the drive gives the rate
  StopRange stop = {};

  bool sprung() const { return law.acts(); }
  /// Force or torque of spring and damper.
  template <class T>
  T spring(const T& value, const T& rate, double time) const {
    return -law.force(T(value - relaxed), rate, time);
  }
};

/// What a kind of joint is made of.
struct JointParts {
  JointFrame frame;
  std::array<int, 2> nodes{};
  std::vector<JointConstraint> constraints;
  std::vector<JointCoordinate> coordinates;
  std::vector<JointFriction> friction;
  bool has_axis = true;        ///< reports reactions along e1, e2, e3 too
  bool drawn_axis = true;      ///< drawn with its axis e1
  bool is_bearing = false;     ///< reports the sizes of force and moment across the axis
  bool has_axial = false;      ///< reports the force along the axis by that name
  bool has_thrust = false;     ///< reports the force along the gap
  bool has_bend = false;       ///< reports the angle between the axes e1 of A and B
  bool has_moment = true;      ///< reports moments
  std::string normal_channel;  ///< name under which the first multiplier is reported, if any
  Vec3 point = Vec3::Zero();   ///< joint point, for pictures
};

/// Any joint between two nodes that is a list of constraints and free coordinates (joint_measures.hpp). The multipliers
/// are forces and moments on B in the joint axes that A carries.
class Joint final : public TemplatedElement<Joint, 2, 20>, public CoordinateOwner {
 public:
  Joint(int id, JointParts parts);
  ~Joint() override;  // where the class is compiled, and nowhere else: it is large

  template <class T>
  void evaluate(const Motion<T, 2>& motion, const State& state, Balance<T, 2>& balance) const;

  void tangent(const State& state, Weights weights, std::span<double> r, std::span<double> k) const override;
  void count_turns(const State& state, std::span<double> scalars, std::span<double> history) const override;
  /// Keeps the direction of sliding, and for a ball the place.
  void commit(const State& state, std::span<double> scalars, std::span<double> history) const override;
  void switches(const State& state, std::span<Switch> values) const override;
  void sliding(const State& state, std::span<Vec3> speeds) const override;
  void grip_limits(const State& state, std::span<double> limits) const override;
  Energies energies(const State& state) const override;
  const std::vector<Channel>& channels() const override { return channels_; }
  void observe(const State& state, std::span<double> values) const override;
  /// Usual kinds of joint that hold some of the same directions and no other.
  std::vector<Release> releases() const override;
  Drawing drawing() const override;

  /// The free ones.
  std::vector<Coordinate> coordinates() const override;

 private:
  /// Friction of each pair of surfaces, for channels.
  using Report = std::vector<JointRub<double>>;

  template <class T>
  void act(const Motion<T, 2>& motion, const State& state, Balance<T, 2>& balance, Report* report) const;

  static double driven_origin(const JointCoordinate& c) { return c.drive.rate_given ? c.origin : 0; }

  /// Entry of an angle's turn count in the history, or -1.
  int counted(Measure what) const;

  /// The friction of surfaces that can rest, and the rows of their grip.
  template <class T>
  JointRub<T> rest(const JointFriction& f, std::size_t grip, const JointPose<T>& pose, const Vec3T<T>& force,
                   const Vec3T<T>& moment, const Measured<T>& turn, const Vec3T<T>& normal, const JointRates<T>& rates,
                   const State& state, Balance<T, 2>& balance) const;

  template <class T>
  Measured<T> measured(Measure what, const JointPose<T>& pose, const State& state) const;
  template <class T, class Node>
  JointRates<T> rates_of(const JointPose<T>& pose, const Node& a, const Node& b) const;

  struct Observed {
    double value, rate;
  };
  Observed observed(const JointCoordinate& c, const State& state) const;
  Report rubbed(const State& state) const;
  void name_channels();

  JointParts parts_;
  bool moves_ = false;           ///< something acts along or against the free motion
  bool has_rates_ = false;       ///< and depends on its speed
  bool whole_b_ = false;         ///< what acts looks at B's second or third axis
  std::vector<Measure> angles_;  ///< counted in turns, in the order of the history
  std::vector<Channel> channels_;
};

}  // namespace engrane::elements::joints
