// SPDX-License-Identifier: BSD-3-Clause
// The quantities that joints constrain, drive and measure: scalar functions of the pose of B relative to A, with gradients.
#pragma once

#include <cmath>
#include <type_traits>

#include "elements/common/axis_angle.hpp"

namespace engrane::elements::joints {

/// A function of the relative pose. e_i are the joint axes carried by A, ê_i those carried by B, and d the vector from A's
/// joint point to B's.
enum class Measure {
  gap_1,  ///< e1·d and so on: coordinates of B's point in A's axes
  gap_2,
  gap_3,
  tilt_2,  ///< −e3·ê1: small rotation about e2 of B's axis relative to A's
  tilt_3,  ///< e2·ê1
  turn_1,  ///< e_i·w, w = 2 tan(θ/2) n the Rodrigues vector of the relative rotation
  turn_2,
  turn_3,
  pins,      ///< e1·ê2: zero when A's pin and B's pin cross at right angles
  angle,     ///< angle of B relative to A about e1 (axis_angle)
  pin_a,     ///< angle of a universal joint's cross relative to A, about e1
  pin_b,     ///< angle of B relative to the cross, about ê2
  distance,  ///< |d|
  screw,     ///< e1·d − lead · angle
  twist,     ///< `angle` when it is held at zero, so that no turns are counted
  radius,    ///< |d − e1 e1·d|: distance of B's point from A's axis e1
  azimuth,   ///< atan2(e3·d, e2·d): angle of B's point around that axis
};

/// Whether the measure is an angle whose whole turns are counted.
inline bool is_turn(Measure m) {
  return m == Measure::angle || m == Measure::pin_a || m == Measure::pin_b || m == Measure::azimuth;
}

/// Joint axes and joint point on each node, in the reference configuration.
struct JointFrame {
  Vec3 e1 = Vec3::UnitX(), e2 = Vec3::UnitY(), e3 = Vec3::UnitZ();  ///< on A
  Vec3 b1 = Vec3::UnitX(), b2 = Vec3::UnitY(), b3 = Vec3::UnitZ();  ///< on B: the same unless the joint starts bent
  Vec3 arm_a = Vec3::Zero(), arm_b = Vec3::Zero();                  ///< from the node to its joint point
  bool turns_a = true, turns_b = true;                              ///< false: the node's rotation does not affect the joint
  double lead = 0;                                                  ///< of a screw: advance per radian

  /// Sets the axes on both nodes.
  void set_axes(const Vec3& first, const Vec3& second) {
    e1 = b1 = first;
    e2 = b2 = second;
    e3 = b3 = cross(first, second);
  }
};

/// The joint frame carried by the nodes; global components.
template <class T>
struct JointPose {
  Vec3T<T> a1, a2, a3, b1, b2, b3, arm_a, arm_b, gap;
  bool has_arm_a = false, has_arm_b = false;

  template <class Node>
  /// `whole_b` false: B's second and third axes are not computed.
  JointPose(const JointFrame& f, const Node& a, const Node& b, bool whole_b = true) {
    const auto carried = [](bool turns, const Node& node, const Vec3& v) {
      return turns ? Vec3T<T>(rotate(node.R, v)) : Vec3T<T>(T(v[0]), T(v[1]), T(v[2]));
    };
    a1 = carried(f.turns_a, a, f.e1);
    a2 = carried(f.turns_a, a, f.e2);
    a3 = carried(f.turns_a, a, f.e3);
    b1 = carried(f.turns_b, b, f.b1);
    if (whole_b) {
      b2 = carried(f.turns_b, b, f.b2);
      b3 = carried(f.turns_b, b, f.b3);
    }
    gap = b.x - a.x;
    has_arm_a = f.arm_a != Vec3::Zero();
    has_arm_b = f.arm_b != Vec3::Zero();
    if (has_arm_a) {
      arm_a = carried(f.turns_a, a, f.arm_a);
      gap -= arm_a;
    } else {
      arm_a.setConstant(T(0));
    }
    if (has_arm_b) {
      arm_b = carried(f.turns_b, b, f.arm_b);
      gap += arm_b;
    } else {
      arm_b.setConstant(T(0));
    }
  }
};

/// A measure's value and gradient: δvalue = force · (δx of B's joint point − δx of the coincident point of A's body) + moment ·
/// (δφ_B − δφ_A). A multiplier times `force` and `moment` acts on B at its joint point, and the opposite acts on A at the same
/// point, so that forces and moments balance whatever the gap.
template <class T>
struct Measured {
  T value = T(0);
  bool pushes = false, turns = false;  ///< whether it has a `force`, and a `moment`
  Vec3T<T> force, moment;

  Measured() {
    if constexpr (std::is_same_v<T, double>) {  // other number types initialise to zero
      force.setZero();
      moment.setZero();
    }
  }
  void set_force(const Vec3T<T>& f) {
    force = f;
    pushes = true;
  }
  void set_moment(const Vec3T<T>& m) {
    moment = m;
    turns = true;
  }
};

namespace joint_measures {

template <class T>
Measured<T> along(const Vec3T<T>& e, const JointPose<T>& p) {
  Measured<T> m;
  m.value = dot(e, p.gap);
  m.set_force(e);
  return m;
}

/// a·b of a vector carried by A and one carried by B: δ(a·b) = (b×a)·(δφ_B − δφ_A).
template <class T>
Measured<T> product(const Vec3T<T>& a, const Vec3T<T>& b) {
  Measured<T> m;
  m.value = dot(a, b);
  m.set_moment(cross(b, a));
  return m;
}

/// e·w with w = 2 Σ e_i×ê_i / (1 + Σ e_i·ê_i) = 2 tan(θ/2) n. A spatial rotation δφ of B relative to A changes it by δw = δφ +
/// ½ δφ×w + ¼ w w·δφ (composition of Rodrigues vectors).
template <class T>
Measured<T> turned(const Vec3T<T>& e, const JointPose<T>& p) {
  const T factor = T(2) / (T(1) + dot(p.a1, p.b1) + dot(p.a2, p.b2) + dot(p.a3, p.b3));
  const Vec3T<T> w = (cross(p.a1, p.b1) + cross(p.a2, p.b2) + cross(p.a3, p.b3)) * factor;
  Measured<T> m;
  m.value = dot(e, w);
  m.set_moment(e + w * (m.value * 0.25) + cross(w, e) * 0.5);
  return m;
}

/// atan2(s·t, c·t), with t carried by one node and the perpendicular unit vectors s, c by the other.
template <class T>
Measured<T> pin_angle(const Vec3T<T>& s, const Vec3T<T>& c, const Vec3T<T>& t) {
  using std::atan2;
  const T y = dot(s, t), x = dot(c, t), scale = T(1) / (x * x + y * y);
  Measured<T> m;
  m.value = atan2(y, x);
  m.set_moment((cross(t, s) * x - cross(t, c) * y) * scale);  // for t carried by B
  return m;
}

}  // namespace joint_measures

/// Evaluates one measure. Angles, including that of a screw, are in (−π, π]; the caller adds counted turns.
template <class T>
Measured<T> measure(Measure what, const JointFrame& frame, const JointPose<T>& p) {
  using namespace joint_measures;
  const auto angle = [&] {
    const AxisAngle<T> turn = axis_angle(std::array{p.a1, p.a2, p.a3}, std::array{p.b1, p.b2, p.b3});
    Measured<T> m;
    m.value = turn.angle;
    m.set_moment(turn.gradient);
    return m;
  };
  switch (what) {
    case Measure::gap_1:
      return along(p.a1, p);
    case Measure::gap_2:
      return along(p.a2, p);
    case Measure::gap_3:
      return along(p.a3, p);
    case Measure::tilt_2: {
      Measured<T> m;
      m.value = -dot(p.a3, p.b1);
      m.set_moment(cross(p.a3, p.b1));
      return m;
    }
    case Measure::tilt_3:
      return product(p.a2, p.b1);
    case Measure::turn_1:
      return turned(p.a1, p);
    case Measure::turn_2:
      return turned(p.a2, p);
    case Measure::turn_3:
      return turned(p.a3, p);
    case Measure::pins:
      return product(p.a1, p.b2);
    case Measure::angle:
    case Measure::twist:
      return angle();
    case Measure::pin_a:
      return pin_angle(p.a3, p.a2, p.b2);
    case Measure::pin_b: {
      // seen from B the cross turns the other way: ê3 = ê1×ê2 is on the side to which A's pin swings
      Measured<T> m = pin_angle(p.b3, p.b1, p.a1);
      m.moment = Vec3T<T>(-m.moment);
      return m;
    }
    case Measure::distance: {
      using std::sqrt;
      Measured<T> m;
      m.value = sqrt(dot(p.gap, p.gap));
      m.set_force(p.gap * (T(1) / m.value));
      return m;
    }
    case Measure::screw: {
      const Measured<T> turn = angle();
      Measured<T> m = along(p.a1, p);
      m.value -= frame.lead * turn.value;
      m.set_moment(turn.moment * T(-frame.lead));
      return m;
    }
    case Measure::radius: {
      using std::sqrt;
      const T second = dot(p.a2, p.gap), third = dot(p.a3, p.gap);
      Measured<T> m;
      m.value = sqrt(second * second + third * third);
      m.set_force((p.a2 * second + p.a3 * third) * (T(1) / m.value));
      return m;
    }
    case Measure::azimuth: {
      using std::atan2;
      const T second = dot(p.a2, p.gap), third = dot(p.a3, p.gap);
      Measured<T> m;
      m.value = atan2(third, second);
      m.set_force((p.a3 * second - p.a2 * third) * (T(1) / (second * second + third * third)));
      return m;
    }
  }
  return {};
}

}  // namespace engrane::elements::joints
