// SPDX-License-Identifier: BSD-3-Clause
// Contact force as a function of the penetration δ and its rate δ̇.
#pragma once

#include <algorithm>
#include <cmath>

#include "math/dual.hpp"
#include "math/taylor.hpp"

namespace engrane::elements {

/// F = k δⁿ (1 + d δ̇) (Hunt and Crossley, J. Appl. Mech. 42 (1975), p. 440) or F = k δⁿ + c δ̇. Never negative, and zero while
/// the contact is open.
struct StopLaw {
  double stiffness = 0, exponent = 1;
  double hunt = 0;    ///< d
  double linear = 0;  ///< c
  /// Penetration at which the spring that bridges gaps resists as the contact does; less deep it is stiffer, and never leads
  /// farther. Best some size of the parts: like the spring, it leads a search, but does not change what is found.
  double reach = 1;

  bool damped() const { return hunt > 0 || linear > 0; }

  /// k δⁿ for δ > 0.
  template <class T>
  T elastic(const T& pressed) const {
    if (exponent == 1) return stiffness * pressed;
    const double x = value_of(pressed), n = exponent, f = stiffness * std::pow(x, n);
    return compose(pressed, f, n * f / x, n * (n - 1) * f / (x * x));
  }

  /// Contact force. `contact_homotopy` is the fraction of it that a linear spring replaces, which also acts across an open gap,
  /// while statics searches for contacts (State::contact_homotopy). Unlike a contact with n > 1 it resists where they only touch.
  template <class T>
  T force(const T& pressed, const T& rate, double contact_homotopy) const {
    const T contact = value_of(pressed) > 0 ? pushing(pressed, rate) : T(0);
    if (contact_homotopy == 0) return contact;
    return (1 - contact_homotopy) * contact + contact_homotopy * stiffness * std::pow(reach, exponent - 1) * pressed;
  }

  double stored(double pressed) const { return pressed > 0 ? stiffness * std::pow(pressed, exponent + 1) / (exponent + 1) : 0; }

  /// Switch function for the force being clipped at zero in contact: it has the sign of the unclipped force, but not the powers
  /// of δ that make that vanish at δ = 0.
  double pressure(double pressed, double rate) const { return linear > 0 ? elastic(pressed) + linear * rate : 1 + hunt * rate; }
  double pressure_rate(double pressed, double rate, double second) const {
    return linear > 0 ? exponent * elastic(pressed) / pressed * rate + linear * second : hunt * second;
  }

  /// Magnitude of its terms, for the rounding error.
  double pressure_size(double pressed, double rate) const {
    return linear > 0 ? elastic(pressed) + linear * std::abs(rate) : 1 + hunt * std::abs(rate);
  }

  /// Hunt–Crossley coefficient d for which a free body arriving at speed v rebounds at e v, 0 < e ≤ 1, for any n, k and mass.
  ///
  /// With m δ̈ = −k δⁿ (1 + d δ̇) the speeds at δ = 0 before and after satisfy x (1 + e) = ln((1 + x)/(1 − e x)), x = d v,
  /// since v dv/(1 + d v) = −(k/m) δⁿ dδ has the same integral in compression and in rebound.
  static double hunt_of_restitution(double e, double speed) {
    if (e >= 1) return 0;
    // `imbalance` is negative for small x and infinite at 1/e
    double lo = 0, hi = 1 / e;
    for (int i = 0; i < 200 && hi - lo > 1e-16 * hi; ++i) {
      const double middle = 0.5 * (lo + hi);
      (imbalance(middle, e) < 0 ? lo : hi) = middle;
    }
    return 0.5 * (lo + hi) / speed;
  }

 private:
  /// The force for δ > 0.
  template <class T>
  T pushing(const T& pressed, const T& rate) const {
    const T total = elastic(pressed) * (T(1) + hunt * rate) + linear * rate;
    return value_of(total) > 0 ? total : T(0);
  }

  /// ln((1 + x)/(1 − e x)) − x (1 + e). Where the logarithms cancel, its series divided by x²; only the sign matters.
  static double imbalance(double x, double e) {
    if (x > 0.05) return std::log1p(x) - std::log1p(-e * x) - x * (1 + e);
    double sum = (e * e - 1) / 2, power_x = 1, power_e = e * e, sign = 1;
    for (int k = 3; k <= 16; ++k) {
      power_x *= x;
      power_e *= e;
      sign = -sign;
      sum += power_x * (power_e - sign) / k;
    }
    return sum;  // divided by x²
  }
};

}  // namespace engrane::elements
