// SPDX-License-Identifier: BSD-3-Clause
#include "math/rotation.hpp"

#include <cmath>

#include "math/linear_rotation.hpp"

namespace engrane {

Mat3 rotation_change(const Vec3& y) {
  const double angle = y.norm();
  // sin(a)/a and (1 - cos a)/a² = ½ (sin(a/2)/(a/2))²: no cancellation at any angle
  const double s = angle < 1e-8 ? 1 - angle * angle / 6 : std::sin(angle) / angle;
  const double half = 0.5 * angle;
  const double c = half < 1e-8 ? 1 - half * half / 6 : std::sin(half) / half;
  const Mat3 Y = skew(y);
  return s * Y + 0.5 * c * c * Y * Y;
}

Mat3 rotation_exp(const Vec3& y) { return Mat3::Identity() + rotation_change(y); }

Vec3 rotation_log(const Mat3& R) {
  if (is_linear_rotation(R)) return linear_rotation_vector<double>(R);
  // via the quaternion: its vector part keeps full precision both near 0 and near π
  Eigen::Quaterniond q(R);
  // at half a turn both senses are valid, and rounding must not choose between them
  constexpr double half_turn = 1e-9;
  Eigen::Index largest = 0;
  q.vec().cwiseAbs().maxCoeff(&largest);
  if (std::abs(q.w()) < half_turn ? q.vec()[largest] < 0 : q.w() < 0) q.coeffs() = -q.coeffs();
  const double n = q.vec().norm();
  if (n < 1e-150) return Vec3::Zero();
  return q.vec() * (2 * std::atan2(n, q.w()) / n);
}

Mat3 rotation_tangent(const Vec3& y) {
  const double a = y.norm();
  const double half = 0.5 * a;
  const double c = half < 1e-8 ? 1 - half * half / 6 : std::sin(half) / half;
  // (a - sin a)/a³ suffers cancellation below a few tenths: use its series there
  const double a2 = a * a;
  const double third = a < 0.3 ? 1.0 / 6 - a2 / 120 * (1 - a2 / 42 * (1 - a2 / 72 * (1 - a2 / 110 * (1 - a2 / 156))))
                               : (a - std::sin(a)) / (a2 * a);
  const Mat3 Y = skew(y);
  return Mat3::Identity() - 0.5 * c * c * Y + third * Y * Y;
}

Vec3 rotation_tangent_rate(const Vec3& y, const Vec3& rate, const Vec3& w) {
  // T = 1 − b Y + c Y² with b = (1 − cos a)/a² and c = (a − sin a)/a³; b′/a and c′/a suffer cancellation below 0.5: series
  // there
  const double a = y.norm(), a2 = a * a;
  const bool small = a < 0.5;
  const double third =
      small ? 1.0 / 6 - a2 / 120 * (1 - a2 / 42 * (1 - a2 / 72 * (1 - a2 / 110 * (1 - a2 / 156)))) : (a - std::sin(a)) / (a2 * a);
  const double slope_b = small ? -1.0 / 12 + a2 * (1.0 / 180 - a2 * (1.0 / 6720 - a2 * (1.0 / 453600 - a2 / 47900160)))
                               : (a * std::sin(a) - 2 * (1 - std::cos(a))) / (a2 * a2);
  const double slope_c = small ? -1.0 / 60 + a2 * (1.0 / 1260 - a2 * (1.0 / 60480 - a2 * (1.0 / 4989600 - a2 / 622702080)))
                               : (3 * std::sin(a) - 2 * a - a * std::cos(a)) / (a2 * a2 * a);
  const double half = std::sin(a / 2);
  const double second = a2 > 0 ? 2 * half * half / a2 : 0.5;
  const Vec3 once = y.cross(w), changed = rate.cross(w);
  return y.dot(rate) * (slope_c * y.cross(once) - slope_b * once) + third * (rate.cross(once) + y.cross(changed)) -
         second * changed;
}

Mat3 orthonormalized(const Mat3& R) {
  // one Newton step of the polar decomposition suffices: convergence is quadratic, and R is orthogonal up to rounding
  return 0.5 * R * (3 * Mat3::Identity() - R.transpose() * R);
}

}  // namespace engrane
