// SPDX-License-Identifier: BSD-3-Clause
// Dry friction in joints, from the forces that the joint itself carries.
#pragma once

#include <array>
#include <cmath>
#include <string>

#include "elements/common/friction_law.hpp"
#include "elements/joints/joint_measures.hpp"
#include "math/rotation.hpp"
#include "model/grip.hpp"

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

  /// The coordinate along which surfaces slide that have but one: its force is the force or moment of friction.
  bool along_line() const { return kind == Rubbing::journal || kind == Rubbing::guide || kind == Rubbing::thread; }
  /// The coordinates along which the surfaces slide, with their levers. The lever of a coordinate that is the only one is 1.
  GripShape shape() const {
    const auto count = [this](int slides) { return slides + (radius > 0 ? 1 : 0); };
    switch (kind) {
      case Rubbing::sleeve:
        return {count(1), {1, radius, 1}};
      case Rubbing::face:
        return {count(2), {1, 1, radius}};
      case Rubbing::ball:
        return {3, {radius, radius, radius}};
      default:
        return {};
    }
  }
  std::array<Measure, 3> coordinates() const {
    switch (kind) {
      case Rubbing::guide:
        return {Measure::gap_1};
      case Rubbing::sleeve:
        return {Measure::gap_1, turn};
      case Rubbing::face:
        return {Measure::gap_2, Measure::gap_3, turn};
      case Rubbing::ball:
        return {Measure::turn_1, Measure::turn_2, Measure::turn_3};
      default:
        return {turn};
    }
  }
};

/// The pose with B turned back by the rotation vector that took it from A's axes (in these axes) to where it rested.
template <class T>
JointPose<T> since_rest(const JointPose<T>& pose, const Vec3& turned) {
  const Mat3 Q = rotation_exp(turned);
  JointPose<T> back = pose;
  const auto axis = [&](Eigen::Index i) { return Vec3T<T>(pose.b1 * Q(i, 0) + pose.b2 * Q(i, 1) + pose.b3 * Q(i, 2)); };
  back.b1 = axis(0);
  back.b2 = axis(1);
  back.b3 = axis(2);
  return back;
}

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
  Vec3 sliding = Vec3::Zero();    ///< its velocity, in any axes; only of numbers without derivatives
  double limit = 0;               ///< largest force on the coordinate at rest; only of surfaces that can rest
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

/// Force and moment on B of a unit force on the coordinate of surfaces that slide along a line. A nut on its thread advances by
/// `lead` per radian: its friction, along the thread, does the work of a moment of 1 when it has these parts.
template <class T>
void rub_along(const JointFriction& f, const JointPose<T>& pose, const Measured<T>& turn, double lead, const T& amount,
               JointRub<T>& out) {
  if (f.kind == Rubbing::guide) {
    out.force += pose.a1 * amount;
  } else if (f.kind == Rubbing::journal) {
    out.moment += turn.moment * amount;
  } else {
    const double r2 = f.radius * f.radius, share = 1 / (lead * lead + r2);
    out.force += pose.a1 * (amount * (lead * share));
    out.moment += turn.moment * (amount * (r2 * share));
  }
}

/// The pressing forces N of a shaft or slider in its bushes, and the lever of each: its speed over the rate of the coordinate,
/// where there is but one (JointFriction::along_line).
template <class T>
struct Pressed {
  T normal;
  double lever;
};
template <class T>
std::array<Pressed<T>, 2> pressed(const JointFriction& f, const JointPose<T>& pose, const Vec3T<T>& F, const Vec3T<T>& M,
                                  double lead) {
  using namespace joint_friction;
  const Vec3T<T>& e = f.kind == Rubbing::journal && f.turn == Measure::pin_b ? pose.b2 : pose.a1;
  T N = bushes(F, M, e, f.length) + f.preload;
  const Pressed<T> none{T(0), 0};
  if (f.kind == Rubbing::journal)
    return {Pressed<T>{N, f.radius}, f.collar > 0 ? Pressed<T>{size(T(dot(F, e))), f.collar} : none};
  if (f.kind == Rubbing::guide) {
    if (f.radius > 0) N += size(T(dot(M, e))) * (1 / f.radius);  // a key, or two rails
    return {Pressed<T>{N, 1}, none};
  }
  if (f.kind == Rubbing::thread) N += size(T(dot(F, e))) * f.steep;
  return {Pressed<T>{N, std::sqrt(lead * lead + f.radius * f.radius)}, none};
}

/// What presses surfaces together that slide along more than a line.
template <class T>
T pressing(const JointFriction& f, const JointPose<T>& pose, const Vec3T<T>& F, const Vec3T<T>& M) {
  if (f.kind == Rubbing::face || f.kind == Rubbing::ball) return joint_friction::size(F) + f.preload;
  return pressed(f, pose, F, M, 0)[0].normal;
}

/// Friction on the coordinates of surfaces that slide along more than a line, with u in a known direction, or rest: `held` holds
/// them.
template <class T>
JointRub<T> rub_towards(const JointFriction& f, const GripState& now, const T& N, const std::array<Measured<T>, 3>& along,
                        const Vec3T<T>& u, const Vec3T<T>& held) {
  const GripShape shape = f.shape();
  JointRub<T> out;
  out.normal = N;
  out.limit = f.law.static_coefficient(value_of(N)) * value_of(N);
  Vec3T<T> friction = held;
  if (now.mode == GripState::sliding) {
    const Vec3T<T> way = now.towards(u, shape.size);
    const T speed = dot(way, u), drag = f.law.at(speed, N) * N;
    friction = way * T(-drag);
    out.power = drag * speed;
  }
  for (std::size_t k = 0; k < static_cast<std::size_t>(shape.size); ++k) {
    const Measured<T>& m = along[k];
    T amount = friction[static_cast<Eigen::Index>(k)];
    if (now.mode == GripState::sliding) amount *= shape.lever[k];
    if (m.pushes) out.force += m.force * amount;
    if (m.turns) out.moment += m.moment * amount;
  }
  return out;
}

/// The friction of surfaces that slide along a line in a known direction, or rest (0), without what holds them at rest.
template <class T>
JointRub<T> rub_in_direction(const JointFriction& f, int direction, const JointPose<T>& pose, const Vec3T<T>& F,
                             const Vec3T<T>& M, const Measured<T>& turn, double lead, const JointRates<T>& rates) {
  JointRub<T> out;
  const T rate = f.kind == Rubbing::guide ? dot(pose.a1, rates.slip) : dot(turn.moment, rates.spin);
  T against(0);
  for (const Pressed<T>& p : pressed(f, pose, F, M, lead)) {
    if (p.lever == 0) continue;
    out.normal += p.normal;
    out.limit += f.law.static_coefficient(value_of(p.normal)) * value_of(p.normal) * p.lever;
    if (direction != 0) against += f.law.at(T(rate * (direction * p.lever)), p.normal) * p.normal * (direction * p.lever);
  }
  rub_along(f, pose, turn, lead, T(-against), out);
  out.power = against * rate;
  return out;
}

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
  const auto slides = [&](const T& first, const T& second, const T& third) {
    if constexpr (std::is_same_v<T, double>) out.sliding = Vec3(first, second, third);
  };
  const auto turning = [&] { return dot(turn.moment, rates.spin); };
  switch (f.kind) {
    case Rubbing::journal: {
      const T rate = turning(), squared = rate * rate;
      const Vec3T<T> w = turn.moment * rate;
      slides(rate * f.radius, T(0), T(0));
      for (const Pressed<T>& p : pressed(f, pose, F, M, 0))
        if (const double lever = p.lever * p.lever; lever > 0) add(p.normal, nullptr, &w, squared * lever, lever);
      break;
    }
    case Rubbing::guide:
    case Rubbing::sleeve:
    case Rubbing::thread: {
      const T sliding = dot(pose.a1, rates.slip);
      const Vec3T<T> u = pose.a1 * sliding;
      const T N = pressing(f, pose, F, M);
      if (f.kind == Rubbing::guide) {
        slides(sliding, T(0), T(0));
        add(N, &u, nullptr, sliding * sliding, 0);
        break;
      }
      const T rate = turning();
      const Vec3T<T> w = turn.moment * rate;
      slides(sliding, rate * f.radius, T(0));
      add(N, &u, &w, sliding * sliding + rate * rate * r2, r2);
      break;
    }
    case Rubbing::face: {
      const T N = pressing(f, pose, F, M);
      const Vec3T<T> u = rates.slip - normal * dot(normal, rates.slip);
      if (f.radius == 0) {
        slides(u[0], u[1], u[2]);
        add(N, &u, nullptr, square(u), 0);
        break;
      }
      const T rate = turning();
      const Vec3T<T> w = turn.moment * rate;
      slides(dot(u, pose.a2), dot(u, pose.a3), rate * f.radius);
      add(N, &u, &w, square(u) + rate * rate * r2, r2);
      break;
    }
    case Rubbing::ball:
      slides(rates.spin[0] * f.radius, rates.spin[1] * f.radius, rates.spin[2] * f.radius);
      add(pressing(f, pose, F, M), nullptr, &rates.spin, square(rates.spin) * r2, r2);
      break;
  }
  return out;
}

}  // namespace engrane::elements::joints
