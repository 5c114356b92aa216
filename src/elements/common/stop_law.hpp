// SPDX-License-Identifier: BSD-3-Clause
// Force of a contact that is pressed together by δ at the rate δ̇.
#pragma once

#include <algorithm>
#include <cmath>

#include "math/dual.hpp"
#include "math/taylor.hpp"

namespace engrane::elements {

/// F = k δⁿ (1 + d δ̇) (Hunt and Crossley, J. Appl. Mech. 42 (1975), p. 440) or F = k δⁿ + c δ̇; never less than zero, and
/// zero while the contact is open.
struct StopLaw {
  double stiffness = 0, exponent = 1;
  double hunt = 0;    ///< d
  double linear = 0;  ///< c

  bool damped() const { return hunt > 0 || linear > 0; }

  /// k δⁿ, δ > 0.
  template <class T>
  T elastic(const T& pressed) const {
    if (exponent == 1) return stiffness * pressed;
    const double x = value_of(pressed), n = exponent, f = stiffness * std::pow(x, n);
    return compose(pressed, f, n * f / x, n * (n - 1) * f / (x * x));
  }

  /// `contact_homotopy`: the part of the spring that pulls across an open gap while statics looks for contacts
  /// (State::contact_homotopy).
  template <class T>
  T force(const T& pressed, const T& rate, double contact_homotopy) const {
    if (!(value_of(pressed) > 0)) {
      // a linear one that just touches has a slope too
      if (contact_homotopy == 0 || (value_of(pressed) == 0 && exponent != 1)) return T(0);
      return -(elastic(T(-pressed)) * contact_homotopy);
    }
    const T total = elastic(pressed) * (T(1) + hunt * rate) + linear * rate;
    return value_of(total) > 0 ? total : T(0);
  }

  double stored(double pressed) const { return pressed > 0 ? stiffness * std::pow(pressed, exponent + 1) / (exponent + 1) : 0; }

  /// Of the same sign as the force would have if it could pull, without the powers of δ that it vanishes with, and its rate.
  double pressure(double pressed, double rate) const { return linear > 0 ? elastic(pressed) + linear * rate : 1 + hunt * rate; }
  double pressure_rate(double pressed, double rate, double second) const {
    return linear > 0 ? exponent * elastic(pressed) / pressed * rate + linear * second : hunt * second;
  }

  /// Size of its terms.
  double pressure_size(double pressed, double rate) const {
    return linear > 0 ? elastic(pressed) + linear * std::abs(rate) : 1 + hunt * std::abs(rate);
  }

  /// d with which a free body that arrives with speed v leaves with e v, 0 < e ≤ 1; whatever n, k and mass.
  ///
  /// From m δ̈ = −k δⁿ (1 + d δ̇) the speeds at δ = 0 before and after obey x (1 + e) = ln((1 + x)/(1 − e x)), x = d v: with
  /// v dv/(1 + d v) = −(k/m) δⁿ dδ both sides integrate to the same.
  static double hunt_of_restitution(double e, double speed) {
    if (e >= 1) return 0;
    // negative for small x, infinite at 1/e
    double lo = 0, hi = 1 / e;
    for (int i = 0; i < 200 && hi - lo > 1e-16 * hi; ++i) {
      const double middle = 0.5 * (lo + hi);
      (imbalance(middle, e) < 0 ? lo : hi) = middle;
    }
    return 0.5 * (lo + hi) / speed;
  }

 private:
  /// ln((1 + x)/(1 − e x)) − x (1 + e); by its series where the logarithms cancel.
  static double imbalance(double x, double e) {
    if (x > 0.05) return std::log1p(x) - std::log1p(-e * x) - x * (1 + e);
    double sum = (e * e - 1) / 2, power_x = 1, power_e = e * e, sign = 1;
    for (int k = 3; k <= 16; ++k) {
      power_x *= x;
      power_e *= e;
      sign = -sign;
      sum += power_x * (power_e - sign) / k;
    }
    return sum;  // over x²
  }
};

}  // namespace engrane::elements
