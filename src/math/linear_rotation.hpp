// SPDX-License-Identifier: BSD-3-Clause
// Rotations of linear models.
#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "math/dual.hpp"
#include "math/taylor.hpp"
#include "math/vector.hpp"

namespace engrane {

/// The linearised rotation matrix I + θ×. Where all forces are linear in the displacements, rotations are vectors θ that add up,
/// of any length. Nodes of such a model have this matrix in place of exp(θ), from which no vector longer than π can be told.
inline Mat3 linear_rotation(const Vec3& theta) { return Mat3::Identity() + skew(theta); }

/// Whether R is I + θ×: its diagonal is 1, that of a rotation smaller. For |θ| < 1e-7 the answer is no, as both kinds are then
/// equal up to rounding.
template <class R>
bool is_linear_rotation(const R& rotation) {
  constexpr double least = 1e-7;  // cosines of less than 1.5e-8 are rounded to 1
  for (int i = 0; i < 3; ++i)
    if (value_of(rotation(i, i)) != 1) return false;
  return std::max({std::abs(value_of(rotation(2, 1))), std::abs(value_of(rotation(0, 2))), std::abs(value_of(rotation(1, 0)))}) >
         least;
}

/// θ of a matrix I + θ×. Increments of the matrix are R δθ×, as those of any rotation.
template <class T>
Vec3T<T> linear_rotation_vector(const Mat3T<T>& R) {
  const Vec3 theta(value_of(R(2, 1)), value_of(R(0, 2)), value_of(R(1, 0)));
  if constexpr (std::is_same_v<T, double>) return theta;
  const Mat3 back = linear_rotation(theta).inverse();
  const auto entry = [&](int i, int j) { return R(0, j) * back(i, 0) + R(1, j) * back(i, 1) + R(2, j) * back(i, 2); };
  const Vec3T<T> change((entry(2, 1) - entry(1, 2)) * T(0.5), (entry(0, 2) - entry(2, 0)) * T(0.5),
                        (entry(1, 0) - entry(0, 1)) * T(0.5));
  return theta.template cast<T>() + change;
}

/// Components of a moment in the axes of a node: its own, which do not turn in a linear model.
template <class A, class B>
auto moment_on_node(const Mat3T<A>& R, const Vec3T<B>& moment) {
  using Components = decltype(rotate_back(R, moment));
  return is_linear_rotation(R) ? Components(moment) : rotate_back(R, moment);
}
/// The reverse.
inline Vec3 moment_in_space(const Mat3& R, const Vec3& moment) { return is_linear_rotation(R) ? moment : Vec3(R * moment); }

}  // namespace engrane
