// SPDX-License-Identifier: BSD-3-Clause
// Dry friction in joints, computed from the forces that the joint itself carries.
#pragma once

#include <array>
#include <cmath>
#include <string>

#include "elements/common/friction_law.hpp"
#include "elements/joints/joint_measures.hpp"
#include "math/rotation.hpp"
#include "model/grip.hpp"

namespace engrane::elements::joints {

/// The rubbing surfaces of a joint: determines the normal force and the sliding velocity.
enum class Rubbing {
  journal,  ///< a pin in its bushes and on its collar: rotates
  guide,    ///< a slider on its guide: slides along e1
  sleeve,   ///< a sleeve on a round shaft: slides along e1 and rotates
  thread,   ///< a nut on its thread: likewise, pressed by the axial force as well
  face,     ///< a face or a point on a plane: slides across the normal and may spin about it
  drum,     ///< a point on a drum: slides along e1 and around it
  ball      ///< a ball in its socket
};

/// One pair of rubbing surfaces. The sliding velocity u = (u_s, r w) combines the sliding velocity u_s of B's joint point and
/// the spin w at the radius r. The friction on B is −μ(u, N) N u/|u|: a force −μ N u_s/|u| and a moment −μ N r² w/|u|. The
/// opposite acts on A. The power −μ N |u| is never positive.
struct JointFriction {
  Rubbing kind = Rubbing::journal;
  FrictionLaw law;
  double radius = 0;   ///< 0: no friction against rotation; that of the surface of a drum
  double collar = 0;   ///< radius at which a journal's axial force rubs; 0: no friction from it
  double length = 0;   ///< distance of the two bushes, or shoes, that carry bending moments; 0: moments do not press
  double preload = 0;  ///< normal force in addition to that of the load
  double steep = 1;    ///< thread: normal force per axial force, 1/(cos λ cos α_n)
  Measure turn = Measure::angle;
  std::string suffix;  ///< suffix of the channel names

  /// Whether the surfaces slide along a single coordinate; friction is then a force or moment on that coordinate.
  bool along_line() const { return kind == Rubbing::journal || kind == Rubbing::guide || kind == Rubbing::thread; }
  /// Number of coordinates along which the surfaces slide, with their levers. A single coordinate has lever 1.
  GripShape shape() const {
    const auto count = [this](int slides) { return slides + (radius > 0 ? 1 : 0); };
    switch (kind) {
      case Rubbing::sleeve:
      case Rubbing::drum:
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
      case Rubbing::drum:
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

/// The pose with B turned back by `turned`, its rotation relative to A at the place of rest (a rotation vector in A's axes), so
/// that only the rotation since then remains.
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

/// Velocity of B's joint point relative to the coincident point of A's body, and angular velocity of B relative to A; global
/// components.
template <class T>
struct JointRates {
  Vec3T<T> slip, spin;
};

/// Friction force and moment on B at its joint point, with the quantities they follow from.
template <class T>
struct JointRub {
  Vec3T<T> force = Vec3T<T>(T(0), T(0), T(0)), moment = Vec3T<T>(T(0), T(0), T(0));
  T normal = T(0), power = T(0);  ///< normal force and dissipated power
  Vec3 sliding = Vec3::Zero();    ///< sliding velocity, in arbitrary axes; only for numbers without derivatives
  double limit = 0;               ///< largest force on the coordinate at rest; only for surfaces that can stick
};

namespace joint_friction {

template <class T>
T square(const Vec3T<T>& v) {
  return dot(v, v);
}

/// |v|, with zero derivative at zero.
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

/// Sum of the bearing forces on a shaft along e under the force F and the moment M: two bushes at ±length/2 from the joint
/// point carry F_t/2 ± M×e/length. With length 0 the moment adds nothing.
template <class T>
T bushes(const Vec3T<T>& F, const Vec3T<T>& M, const Vec3T<T>& e, double length) {
  const Vec3T<T> across = F - e * dot(F, e);
  if (length == 0) return size(across);
  const Vec3T<T> half = across * 0.5, couple = cross(M, e) * (1 / length);
  return size(Vec3T<T>(half + couple)) + size(Vec3T<T>(half - couple));
}

}  // namespace joint_friction

/// Adds to `out` the force and moment on B that correspond to the generalised force `amount` on the single coordinate of the
/// surfaces. A nut advances by `lead` per radian: its friction acts along the thread, and the two parts together do the work of
/// a moment `amount`.
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

/// Normal force N of a shaft or slider in its bushes, and its lever: sliding speed over the rate of the coordinate, if there is
/// only one (JointFriction::along_line).
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

/// Normal force of surfaces that slide along several coordinates.
template <class T>
T pressing(const JointFriction& f, const JointPose<T>& pose, const Vec3T<T>& F, const Vec3T<T>& M) {
  if (f.kind == Rubbing::face || f.kind == Rubbing::drum || f.kind == Rubbing::ball) return joint_friction::size(F) + f.preload;
  return pressed(f, pose, F, M, 0)[0].normal;
}

/// Friction of surfaces that slide along several coordinates with velocity u, in a known direction, or are at rest under the
/// forces `held`.
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

/// Friction of surfaces that slide along a single coordinate in a known direction, or are at rest (0); excludes the force that
/// holds them at rest.
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

/// Friction as a function of the sliding velocity alone. The constraints exert the force F and the moment M on B at its joint
/// point. `turn` is the measure JointFriction::turn, if the kind has one; `normal` is the normal of a face or drum.
template <class T>
JointRub<T> rub(const JointFriction& f, const JointPose<T>& pose, const Vec3T<T>& F, const Vec3T<T>& M, const Measured<T>& turn,
                const Vec3T<T>& normal, const JointRates<T>& rates) {
  using namespace joint_friction;
  JointRub<T> out;
  const double r2 = f.radius * f.radius;
  /// Adds the friction of surfaces with normal force N that slide with u and spin with w at radius √lever_squared.
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
    case Rubbing::face:
    case Rubbing::drum: {
      const T N = pressing(f, pose, F, M);
      const Vec3T<T> u = rates.slip - normal * dot(normal, rates.slip);
      if (f.radius == 0 || f.kind == Rubbing::drum) {
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
