// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace engrane {

template <class T>
using Vec3T = Eigen::Matrix<T, 3, 1>;
template <class T>
using Mat3T = Eigen::Matrix<T, 3, 3>;
using Vec3 = Vec3T<double>;
using Mat3 = Mat3T<double>;

/// Written out instead of using Eigen's: compilers optimise short plain loops over dual numbers best.
template <class A, class B>
auto cross(const Vec3T<A>& a, const Vec3T<B>& b) {
  using T = decltype(a[0] * b[0]);
  return Vec3T<T>(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
}
template <class A, class B>
auto dot(const Vec3T<A>& a, const Vec3T<B>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
/// R b and Rᵀ b; either operand may be of plain or of dual numbers.
template <class A, class B>
auto rotate(const Mat3T<A>& R, const Vec3T<B>& b) {
  using T = decltype(R(0, 0) * b[0]);
  Vec3T<T> r;
  for (int i = 0; i < 3; ++i) r[i] = R(i, 0) * b[0] + R(i, 1) * b[1] + R(i, 2) * b[2];
  return r;
}
template <class A, class B>
auto rotate_back(const Mat3T<A>& R, const Vec3T<B>& b) {
  using T = decltype(R(0, 0) * b[0]);
  Vec3T<T> r;
  for (int i = 0; i < 3; ++i) r[i] = R(0, i) * b[0] + R(1, i) * b[1] + R(2, i) * b[2];
  return r;
}

/// The matrix of the cross product: skew(a) b = a × b.
inline Mat3 skew(const Vec3& a) {
  Mat3 m;
  m << 0, -a[2], a[1], a[2], 0, -a[0], -a[1], a[0], 0;
  return m;
}

/// A unit vector perpendicular to the unit vector `a`, chosen deterministically from the coordinate axes.
Vec3 perpendicular(const Vec3& a);

}  // namespace engrane
