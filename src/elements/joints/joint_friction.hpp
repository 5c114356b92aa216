// SPDX-License-Identifier: BSD-3-Clause
// Dry friction in joints, from the forces that the joint itself carries.
#pragma once

#include <string>

#include "elements/common/friction_law.hpp"
#include "elements/joints/joint_measures.hpp"

namespace engrane::elements::joints {

/// Where the parts of a joint rub, which says what presses them together and how they slide.
enum class Rubbing {
  journal,  ///< a pin in its bushes and on its collar: turns
  guide,    ///< a slider on its guide: slides along e1
  sleeve,   ///< a sleeve on a round shaft: slides along e1 and turns
  thread,   ///< a nut on its thread: the same, pressed by the axial force
  face,     ///< a face on a plane, or a point on a surface: slides across the normal and may spin about it
  ball      ///< a ball in its socket
};

/// One pair of rubbing surfaces. The sliding velocity is u = (u_s, r w) of the sliding u_s of B's joint point and the spin w; the
/// friction is −μ(u, N) N u/|u| on B, and the opposite on A: a force −μ N u_s/|u| and a moment −μ N r² w/|u|. Its power is
/// −μ N |u|, never positive.
struct JointFriction {
  Rubbing kind = Rubbing::journal;
  FrictionLaw law;
  double radius = 0;   ///< 0: turning does not rub
  double collar = 0;   ///< radius at which a journal's axial force rubs; 0: it does not
  double length = 0;   ///< between the two bushes, or shoes, that carry bending moments; 0: these press nothing
  double preload = 0;  ///< force that presses the surfaces together besides the load
  double steep = 1;    ///< of a thread: normal force per axial force, 1/(cos λ cos α_n)
  Measure turn = Measure::angle;
  std::string suffix;  ///< of channels
};

/// Velocity of B's joint point relative to the point of A's body there, and of B's rotation relative to A's.
template <class T>
struct JointRates {
  Vec3T<T> slip, spin;
};

/// The friction on B at its joint point, and what it comes from.
template <class T>
struct JointRub {
  Vec3T<T> force = Vec3T<T>(T(0), T(0), T(0)), moment = Vec3T<T>(T(0), T(0), T(0));
  T normal = T(0), power = T(0);  ///< pressing force, and power lost
};

namespace joint_friction {

template <class T>
T square(const Vec3T<T>& v) {
  return dot(v, v);
}

/// |v|, with slope zero at zero.
template <class T>
T size(const Vec3T<T>& v) {
  using std::sqrt;
  const T s = square(v);
  return value_of(s) > 0 ? sqrt(s) : T(0);
}
template <class T>
T size(const T& v) {
  return value_of(v) < 0 ? T(-v) : v;
}

/// What force F and moment M press on a shaft along e: two bushes at ±length/2 from the joint point carry F_t/2 ± M×e/length.
template <class T>
T bushes(const Vec3T<T>& F, const Vec3T<T>& M, const Vec3T<T>& e, double length) {
  const Vec3T<T> across = F - e * dot(F, e);
  if (length == 0) return size(across);
  const Vec3T<T> half = across * 0.5, couple = cross(M, e) * (1 / length);
  return size(Vec3T<T>(half + couple)) + size(Vec3T<T>(half - couple));
}

}  // namespace joint_friction

/// The friction of surfaces in a joint whose constraints put the force F and the moment M on B at its joint point. `turn` is the
/// measure of JointFriction::turn, where the kind has one, and `normal` that of a face.
template <class T>
JointRub<T> rub(const JointFriction& f, const JointPose<T>& pose, const Vec3T<T>& F, const Vec3T<T>& M, const Measured<T>& turn,
                const Vec3T<T>& normal, const JointRates<T>& rates) {
  using namespace joint_friction;
  JointRub<T> out;
  const double r2 = f.radius * f.radius;
  /// Adds the friction of surfaces pressed by N that slide with u and spin with w at radius √r².
  const auto add = [&](const T& N, const Vec3T<T>* u, const Vec3T<T>* w, const T& speed_squared, double lever_squared) {
    const T drag = f.law.over_speed(speed_squared, N) * N;
    if (u) out.force -= *u * drag;
    if (w) out.moment -= *w * (drag * lever_squared);
    out.normal += N;
    out.power += drag * speed_squared;
  };
  const auto turning = [&] { return dot(turn.moment, rates.spin); };
  switch (f.kind) {
    case Rubbing::journal: {
      const Vec3T<T>& e = f.turn == Measure::pin_b ? pose.b2 : pose.a1;
      const T rate = turning(), squared = rate * rate;
      const Vec3T<T> w = turn.moment * rate;
      add(bushes(F, M, e, f.length) + f.preload, nullptr, &w, squared * r2, r2);
      if (f.collar > 0) {
        const double lever = f.collar * f.collar;
        add(size(T(dot(F, e))), nullptr, &w, squared * lever, lever);
      }
      break;
    }
    case Rubbing::guide:
    case Rubbing::sleeve:
    case Rubbing::thread: {
      const T sliding = dot(pose.a1, rates.slip);
      const Vec3T<T> u = pose.a1 * sliding;
      T N = bushes(F, M, pose.a1, f.length) + f.preload;
      if (f.kind == Rubbing::guide) {
        if (f.radius > 0) N += size(T(dot(M, pose.a1))) * (1 / f.radius);  // a key, or two rails
        add(N, &u, nullptr, sliding * sliding, 0);
        break;
      }
      if (f.kind == Rubbing::thread) N += size(T(dot(F, pose.a1))) * f.steep;
      const T rate = turning();
      const Vec3T<T> w = turn.moment * rate;
      add(N, &u, &w, sliding * sliding + rate * rate * r2, r2);
      break;
    }
    case Rubbing::face: {
      const T N = size(F) + f.preload;
      const Vec3T<T> u = rates.slip - normal * dot(normal, rates.slip);
      if (f.radius == 0) {
        add(N, &u, nullptr, square(u), 0);
        break;
      }
      const T rate = turning();
      const Vec3T<T> w = turn.moment * rate;
      add(N, &u, &w, square(u) + rate * rate * r2, r2);
      break;
    }
    case Rubbing::ball:
      add(size(F) + f.preload, nullptr, &rates.spin, square(rates.spin) * r2, r2);
      break;
  }
  return out;
}

}  // namespace engrane::elements::joints
