// SPDX-License-Identifier: BSD-3-Clause
#include "elements/bearings/hertz.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace engrane::elements::bearings {

namespace {

/// Complete elliptic integrals for a contact ellipse with a/b = exp(t), e² = 1 − b²/a².
struct Integrals {
  double first, second;  ///< K(e), E(e)
  double square;         ///< e²
  explicit Integrals(double t) : square(-std::expm1(-2 * t)) {
    const double e = std::sqrt(square);
    first = std::comp_ellint_1(e);
    second = std::comp_ellint_2(e);
  }
  /// B/A = ((a/b)² E − K)/(K − E), eq. 4.28.
  double curvature_ratio(double t) const { return (std::exp(2 * t) * second - first) / (first - second); }
};

}  // namespace

PointContact point_contact(double along, double across, double modulus) {
  const auto [a, b] = std::minmax({along / 2, across / 2});
  using std::numbers::pi;
  // the ratio increases with t; bisection tolerates the cancellation in the differences near a circular contact
  double low = 0, high = 20;
  for (int i = 0; i < 60; ++i) {
    const double t = (low + high) / 2;
    (Integrals(t).curvature_ratio(t) < b / a ? low : high) = t;
  }
  const double t = (low + high) / 2;
  const Integrals of(t);
  constexpr double nearly_round = 1e-3;
  // (K − E)/e², by series near a circle
  const double e2 = of.square;
  const double share = t < nearly_round ? pi / 4 * (1 + e2 * (3.0 / 8 + e2 * 15.0 / 64)) : (of.first - of.second) / e2;
  // a³ = 3 Q (K − E)/(2π E* e² A) and δ = 3 Q K/(2π E* a), eq. 4.26 with p₀ = 3Q/2πab, eq. 4.27
  const double half_axis = std::cbrt(3 * share / (2 * pi * modulus * a));  // for Q = 1
  const double approach = 3 * of.first / (2 * pi * modulus * half_axis);
  return {1 / (approach * std::sqrt(approach)), 3 * std::exp(t) / (2 * pi * half_axis * half_axis)};
}

}  // namespace engrane::elements::bearings
