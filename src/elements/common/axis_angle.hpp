// SPDX-License-Identifier: BSD-3-Clause
// Angle of one node relative to another about an axis, with whole turns counted.
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "math/dual.hpp"
#include "math/taylor.hpp"
#include "math/vector.hpp"

namespace engrane::elements {

/// A right-handed triad whose first vector is a unit axis; the other two are chosen by perpendicular().
struct AxisTriad {
  explicit AxisTriad(const Vec3& axis) : e1(axis), e2(perpendicular(axis)), e3(cross(e1, e2)) {}
  Vec3 e1, e2, e3;
};

/// A relative angle and its gradient: δangle = gradient · (δφ_B − δφ_A) for spatial rotations δφ in global components.
template <class T>
struct AxisAngle {
  T angle;
  Vec3T<T> gradient;
};

/// Angle in (−π, π] by which B has turned relative to A about the axis, positive by the right-hand rule. It is the twist of the
/// relative rotation: exact for rotations of any size, and defined unless the axes of A and B are opposite.
///
/// With e_i carried by A and B, θ = atan2(e3A·e2B − e2A·e3B, e2A·e2B + e3A·e3B); its gradient reduces to
/// (e1A + e1B)/(1 + e1A·e1B).
template <class T>
AxisAngle<T> axis_angle(const std::array<Vec3T<T>, 3>& a, const std::array<Vec3T<T>, 3>& b) {
  using std::atan2;
  return {atan2(dot(a[2], b[1]) - dot(a[1], b[2]), dot(a[1], b[1]) + dot(a[2], b[2])),
          Vec3T<T>((a[0] + b[0]) * (T(1) / (T(1) + dot(a[0], b[0]))))};
}
template <class T>
AxisAngle<T> axis_angle(const AxisTriad& triad, const Mat3T<T>& R_a, const Mat3T<T>& R_b) {
  const auto carried = [&triad](const Mat3T<T>& R) {
    return std::array<Vec3T<T>, 3>{rotate(R, triad.e1), rotate(R, triad.e2), rotate(R, triad.e3)};
  };
  return axis_angle(carried(R_a), carried(R_b));
}

/// Counts the whole turns of an angle from step to step. The history holds two numbers: the whole turns and the last angle in
/// (−π, π].
///
/// Between two accepted steps the angle must change by less than half a turn. Whole turns and remainder are stored separately,
/// so that the remainder keeps its precision after any number of turns.
namespace turn_count {

inline constexpr int history = 2;

/// Whole turns to add to an angle in (−π, π].
inline double turns(double angle, std::span<const double> committed) {
  const double change = angle - committed[1];
  if (change > std::numbers::pi) return committed[0] - 1;
  if (change < -std::numbers::pi) return committed[0] + 1;
  return committed[0];
}

/// The total angle, in the number type of `angle`.
template <class T>
T total(const T& angle, std::span<const double> committed) {
  return angle + 2 * std::numbers::pi * turns(value_of(angle), committed);
}

/// Writes the history that the next step starts from.
inline void commit(double angle, std::span<const double> committed, std::span<double> next) {
  next[0] = turns(angle, committed);
  next[1] = angle;
}

}  // namespace turn_count

}  // namespace engrane::elements
