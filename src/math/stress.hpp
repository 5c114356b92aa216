// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <span>

#include "math/vector.hpp"

namespace engrane {

/// Symmetric tensor from the components xx, yy, zz, xy and, if given, yz, zx (otherwise zero).
inline Mat3 symmetric_tensor(std::span<const double> s) {
  const double yz = s.size() > 4 ? s[4] : 0, zx = s.size() > 4 ? s[5] : 0;
  return (Mat3() << s[0], s[3], zx, s[3], s[1], yz, zx, yz, s[2]).finished();
}

/// Row and column of each of the components xx, yy, zz, xy, yz, zx.
inline constexpr Eigen::Index component_rows[6] = {0, 1, 2, 0, 1, 2}, component_columns[6] = {0, 1, 2, 1, 2, 0};

/// The components xx, yy, zz, xy, yz, zx of a symmetric tensor.
inline Eigen::Matrix<double, 6, 1> components_of(const Mat3& s) { return {s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(2, 0)}; }

/// Von Mises equivalent stress of the components of symmetric_tensor().
inline double von_mises(std::span<const double> s) {
  const double xy = s[0] - s[1], yz = s[1] - s[2], zx = s[2] - s[0];
  double shear = 0;
  for (const double one : s.subspan(3)) shear += one * one;
  return std::sqrt((xy * xy + yz * yz + zx * zx) / 2 + 3 * shear);
}

/// Principal stresses. From four components: the two in-plane ones, larger first, then zz. From six: in descending order.
std::array<double, 3> principal_stresses(std::span<const double> s);

}  // namespace engrane
