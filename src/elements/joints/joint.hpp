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
#include "model/determined_channels.hpp"
#include "model/fine_forces.hpp"
#include "model/templated_element.hpp"

namespace engrane::elements::joints {

/// A measure that the joint constrains to a value.
struct JointConstraint {
  Measure measure;
  double value = 0;
};

/// Channel names of a free coordinate.
struct CoordinateNames {
  std::string value, rate;                      ///< SLIDE, SLIDE_SPEED
  std::string spring, drive, power, stop, gap;  ///< SLIDE_SPRING and so on

  static CoordinateNames of(const std::string& value, const std::string& rate) {
    return {value, rate, value + "_SPRING", value + "_DRIVE", value + "_POWER", value + "_STOP", value + "_GAP"};
  }
};

/// A free measure: it is observed, and may have a spring, a damper, a drive and stops.
struct JointCoordinate {
  Measure measure;
  CoordinateNames names;
  SpringLaw law = {};
  double relaxed = 0;  ///< value at which the spring is relaxed
  Drive drive = {};
  double origin = 0;  ///< value at t = 0 when the drive gives the rate
  StopRange stop = {};

  bool sprung() const { return law.acts(); }
  /// Force or torque of spring and damper on the coordinate. `contact_homotopy`: see SpringLaw::force.
  template <class T>
  T spring(const T& value, const T& rate, double time, double contact_homotopy) const {
    return -law.force(T(value - relaxed), rate, time, contact_homotopy);
  }
};

/// The parts that make up a kind of joint.
struct JointParts {
  JointFrame frame;
  std::array<int, 2> nodes{};
  std::vector<JointConstraint> constraints;
  std::vector<JointCoordinate> coordinates;
  std::vector<JointFriction> friction;
  bool has_axis = true;        ///< also reports reactions along e1, e2, e3
  bool drawn_axis = true;      ///< draws the axis e1
  bool is_bearing = false;     ///< reports the magnitudes of force and moment across the axis
  bool has_axial = false;      ///< reports the force along the axis as its own channel
  bool has_thrust = false;     ///< reports the force along the gap vector
  bool has_bend = false;       ///< reports the angle between the e1 axes of A and B
  bool has_moment = true;      ///< reports moments
  std::string normal_channel;  ///< channel name of the first multiplier, if it is reported
  Vec3 point = Vec3::Zero();   ///< joint point, for drawings
};

/// Any joint between two nodes, as a list of constraints and free coordinates (joint_measures.hpp). The multipliers are forces
/// and moments on B, in the joint axes carried by A.
class Joint final : public TemplatedElement<Joint, 2, 20>, public CoordinateOwner, public DeterminedChannels, public FineForces {
 public:
  Joint(int id, JointParts parts);
  ~Joint() override;  // out of line: the class is large

  template <class T>
  void evaluate(const Motion<T, 2>& motion, const State& state, Balance<T, 2>& balance) const;

  void tangent(const State& state, Weights weights, std::span<double> r, std::span<double> k) const override;
  void count_turns(const State& state, std::span<double> scalars, std::span<double> history) const override;
  /// Also stores the direction of sliding, and for a ball the orientation from which rest is measured.
  void commit(const State& state, std::span<double> scalars, std::span<double> history) const override;
  void switches(const State& state, std::span<Switch> values) const override;
  bool has_gaps() const override { return has_gaps_; }
  void sliding(const State& state, std::span<Vec3> speeds) const override;
  void grip_limits(const State& state, std::span<double> limits) const override;
  Energies energies(const State& state) const override;
  const std::vector<Channel>& channels() const override { return channels_; }
  void observe(const State& state, std::span<double> values) const override;
  /// Coordinates of drives, and gaps between two stops.
  std::vector<Determined> determined() const override;
  bool has_fine_forces() const override;
  double determine(int channel, double time, std::span<const double> sources) const override;
  /// Standard joint types that constrain a subset of the same directions.
  std::vector<Release> releases() const override;
  /// Lengths of the arms.
  std::vector<Derived> derived() const override;
  Drawing drawing() const override;

  /// The free coordinates.
  std::vector<Coordinate> coordinates() const override;

 private:
  /// Friction of each pair of surfaces, for channels.
  using Report = std::vector<JointRub<double>>;

  template <class T>
  void act(const Motion<T, 2>& motion, const State& state, Balance<T, 2>& balance, Report* report) const;

  static double driven_origin(const JointCoordinate& c) { return c.drive.rate_given ? c.origin : 0; }

  /// Index of an angle's turn count in the history, or −1.
  int counted(Measure what) const;

  /// Friction of surfaces that can stick; writes the constraint rows of their grip.
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
  /// Force and moment of the joint on B at the joint point, global.
  struct Load {
    Vec3 force, moment;
  };
  Load load_on_b(const State& state, const JointPose<double>& pose) const;
  Report rubbed(const State& state) const;
  void name_channels();
  /// Channel of the rate of the coordinate along which surfaces slide, if it is the only one, driven, and the friction depends
  /// on its speed alone; −1 otherwise.
  int sliding_channel(const JointFriction& f) const;

  JointParts parts_;
  bool moves_ = false;                  ///< there are forces along the free motion
  bool has_rates_ = false;              ///< those forces depend on its rate
  bool sides_ = false;                  ///< whether a guide has switches for the sign of its force across, in the plane
  bool has_gaps_ = false;               ///< stops, springs with corners, or grips
  std::vector<char> slide_along_line_;  ///< of each friction that is regularised: JointFriction::along_line
  bool whole_b_ = false;                ///< those forces need B's second or third axis
  std::vector<Measure> angles_;         ///< angles whose turns are counted, in the order of the history
  std::vector<Channel> channels_;
  std::vector<Determined> gaps_;  ///< channels of gaps between two stops, each with that of its coordinate
  /// A size of friction that follows from the pressing force and the speed of a drive: it has a corner where the sliding turns
  /// back, and bends sharply below the speed at which friction is regularised. Where nothing imposes the speed, such forces are
  /// FineForces.
  struct Rub {
    Determined by;
    std::size_t friction;  ///< index into JointParts::friction
  };
  std::vector<Rub> rubs_;
  std::vector<Determined> sizes_;  ///< channels of sizes of vectors, each with those of the components
};

}  // namespace engrane::elements::joints
