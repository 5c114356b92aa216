// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "math/dual.hpp"
#include "model/function.hpp"
#include "user/routine.hpp"

namespace engrane::elements {

/// Dry friction between two surfaces: the force μ(v, F) F against the sliding velocity v under the normal force F. Below the
/// speed `width` it falls to zero by a polynomial in v with continuous value, slope and curvature; above it the law is exactly
/// Coulomb's. Its power is never negative.
///
/// With `rests` Coulomb's law holds at every speed, with the direction of sliding taken from the history, and there is a
/// coefficient of static friction (GripState).
struct FrictionLaw {
  enum class Kind {
    constant,
    stribeck,  ///< μ_k + (μ_s − μ_k) exp(−(v/v_s)²) + c v
    function   ///< a function of the sliding speed
  };
  Kind kind = Kind::constant;
  double mu = 0;              ///< μ, or μ_s
  double kinetic = 0;         ///< μ_k
  double stribeck_speed = 1;  ///< v_s
  double viscous = 0;         ///< c, per unit of speed
  const Function* of_speed = nullptr;
  const Function* of_load = nullptr;          ///< factor on μ as a function of the normal force; nullptr: 1
  std::shared_ptr<const user::Routine> user;  ///< replaces all of the above: μ as a function of speed and normal force
  double width = 0;                           ///< speed below which the law is regularised; 0: never
  bool rests = false;
  std::optional<double> at_rest;  ///< coefficient of static friction if it differs from μ at zero speed

  /// μ at a sliding speed, with its derivatives, without the load factor.
  Function::Jet coefficient(double speed) const {
    switch (kind) {
      case Kind::constant:
        return {mu, 0, 0, 0};
      case Kind::stribeck: {
        const double s = speed / stribeck_speed, e = (mu - kinetic) * std::exp(-s * s);
        return {kinetic + e + viscous * speed, -2 * s * e / stribeck_speed + viscous,
                (4 * s * s - 2) * e / (stribeck_speed * stribeck_speed), 0};
      }
      case Kind::function:
        return of_speed->at(speed);
    }
    return {};
  }

  /// μ at a sliding speed and normal force. Iterates may have negative speeds: there formulas are continued, while functions
  /// and user routines keep their value at zero.
  template <class T>
  T at(const T& speed, const T& load) const {
    const T v = value_of(speed) < 0 && (user || kind == Kind::function) ? T(0) : speed;
    if (user) {
      const user::Results y = user->at({value_of(v), value_of(load), 0});
      return compose(v, y[0], y[1], 0) + compose(load, 0, y[2], 0);
    }
    const Function::Jet c = coefficient(value_of(v));
    T factor = compose(v, c.f, c.d1, c.d2);
    if (of_load) factor *= evaluate(*of_load, load);
    return factor;
  }

  /// Coefficient of static friction.
  double static_coefficient(double load) const {
    if (!at_rest) return at(0.0, load);
    return *at_rest * (of_load ? of_load->at(load).f : 1);
  }

  /// μ/v, the factor on sliding velocity times normal force; finite at rest if the law is regularised.
  template <class T>
  T over_speed(const T& speed_squared, const T& load) const {
    using std::sqrt;
    constexpr double least = 1e-8;  // relative to the width: keeps the square root differentiable at zero and changes no digit
    if (width == 0 && value_of(speed_squared) == 0) return T(0);
    const T speed = sqrt(speed_squared + least * least * width * width);
    const T factor = at(speed, load);
    if (value_of(speed) >= width) return factor / speed;
    const T s = speed_squared * (1 / (width * width));
    return factor * ((T(15) - s * 10.0 + s * s * 3.0) * (0.125 / width));
  }
};

}  // namespace engrane::elements
