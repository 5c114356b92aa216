// SPDX-License-Identifier: BSD-3-Clause
// The rotation vector of a rotation, for number types that carry derivatives.
#pragma once

#include <cmath>

#include "math/linear_rotation.hpp"

namespace engrane::elements {

/// The rotation vector θ, R = exp(θ), |θ| < π, and its variation under spatial rotations δφ, R → exp(δφ) R:
///
///     δθ = δφ − ½ θ × δφ + κ θ × (θ × δφ),   κ = (1 − (a/2) cot(a/2)) / a²,   a = |θ|
///
/// (Géradin and Cardona, Flexible Multibody Dynamics, 2001, ch. 4; the inverse tangent operator).
template <class T>
struct RotationVector {
  Vec3T<T> theta;
  T kappa;

  /// From a rotation matrix. Not defined at half a turn, where the vector changes sign. A linear_rotation() has its own vector,
  /// which changes by δφ.
  static RotationVector of(const Mat3T<T>& R);

  /// δθ for a spatial rotation δφ, or the rate of θ for an angular velocity.
  Vec3T<T> change(const Vec3T<T>& phi) const {
    return phi - cross(theta, phi) * T(0.5) + cross(theta, Vec3T<T>(cross(theta, phi))) * kappa;
  }
  /// The moment m with m·δφ = f·δθ for all δφ.
  Vec3T<T> moment(const Vec3T<T>& f) const {
    return f + cross(theta, f) * T(0.5) + cross(theta, Vec3T<T>(cross(theta, f))) * kappa;
  }

  /// dκ/d(a²) = (1/8 − 3/2 κ + ½ κ² a²)/a², by the series of κ near zero.
  T kappa_slope() const {
    const T u = dot(theta, theta);
    if (value_of(u) < 0.04)
      return T(1.0 / 720) + u * (T(1.0 / 15120) + u * (T(1.0 / 403200) + u * (T(1.0 / 11975040) + u * T(691.0 / 261534873600))));
    return (T(0.125) - kappa * T(1.5) + kappa * kappa * u * T(0.5)) / u;
  }
};

template <class T>
RotationVector<T> RotationVector<T>::of(const Mat3T<T>& R) {
  using std::atan2, std::sqrt;
  if (is_linear_rotation(R)) return {linear_rotation_vector<T>(R), T(0)};
  // quaternion from its largest component (Shepperd, 1978), which avoids cancellation
  const double trace = value_of(R(0, 0)) + value_of(R(1, 1)) + value_of(R(2, 2));
  Vec3T<T> v;
  T w;
  if (trace > 0) {
    const T root = sqrt(T(1) + R(0, 0) + R(1, 1) + R(2, 2));
    const T scale = T(0.5) / root;
    w = root * T(0.5);
    v = Vec3T<T>((R(2, 1) - R(1, 2)) * scale, (R(0, 2) - R(2, 0)) * scale, (R(1, 0) - R(0, 1)) * scale);
  } else {
    int i = 0;
    for (int c = 1; c < 3; ++c)
      if (value_of(R(c, c)) > value_of(R(i, i))) i = c;
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const T root = sqrt(T(1) + R(i, i) - R(j, j) - R(k, k));
    const T scale = T(0.5) / root;
    v[i] = root * T(0.5);
    v[j] = (R(j, i) + R(i, j)) * scale;
    v[k] = (R(k, i) + R(i, k)) * scale;
    w = (R(k, j) - R(j, k)) * scale;
    if (value_of(w) < 0) {
      w = -w;
      v = Vec3T<T>(-v);
    }
  }
  const T square = dot(v, v);  // sin²(a/2)
  RotationVector out;
  if (value_of(square) < 1e-3) {
    // (a/2)/sin(a/2) by the series of the arcsine, to rounding error
    const T half =
        T(1) + square * (T(1.0 / 6) +
                         square * (T(3.0 / 40) + square * (T(5.0 / 112) + square * (T(35.0 / 1152) + square * T(63.0 / 2816)))));
    out.theta = v * (T(2) * half);
    const T a2 = T(4) * square * half * half;
    out.kappa = T(1.0 / 12) + a2 * (T(1.0 / 720) + a2 * (T(1.0 / 30240) + a2 * T(1.0 / 1209600)));
  } else {
    const T sine = sqrt(square);
    const T half = atan2(sine, w) / sine;
    out.theta = v * (T(2) * half);
    out.kappa = (T(1) - half * w) / (T(4) * square * half * half);
  }
  return out;
}

}  // namespace engrane::elements
