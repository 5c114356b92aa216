// SPDX-License-Identifier: BSD-3-Clause
// Linear control laws in state-space form, with their initial states.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace engrane::elements::control {

/// Maps the reference r and the measured value m to the command y:
///
///     dx/dt = A x + b_r r + b_m m + b_v dm/dt,   y = c x + d_r r + d_m m
///
/// States have the units of y. A law that starts from a steady state takes m through its rate. Its states then do not depend on
/// where the mechanism happens to be, and its steady initial state is known before assembly.
struct ControlLaw {
  static constexpr int most_states = 6;

  Eigen::MatrixXd A;
  Eigen::VectorXd b_r, b_m, b_v, c;
  double d_r = 0, d_m = 0;
  Eigen::VectorXd pace;   ///< per state: an inverse time scale, used to write its equation in units of y
  Eigen::VectorXd start;  ///< initial states
  int integral = -1;      ///< index of the state with anti-windup; −1: none

  int order() const { return static_cast<int>(A.rows()); }

  explicit ControlLaw(int order);

  /// y, with `x(i)` the states.
  template <class T, class States>
  T command(const T& r, const T& m, const States& x) const {
    T y = d_r * r + d_m * m;
    for (int i = 0; i < order(); ++i)
      if (c[i] != 0) y += c[i] * x(i);
    return y;
  }

  struct Pid {
    double proportional = 0, integral = 0, derivative = 0;
    double filter = 0;          ///< time constant of the derivative
    double integral_start = 0;  ///< initial value of the integral part of y
  };
  /// y = KP e + KI ∫e dt + KD s/(1 + filter s) e with e = r − m. `reference` is the initial r, for which the derivative part
  /// starts at zero. `by_rate`: dm/dt is available.
  static ControlLaw pid(const Pid& gains, double reference, bool by_rate);

  /// y = N(s)/D(s) e. Coefficients start with the highest power, as in MATLAB; the degree of N is at most that of D, and the
  /// first coefficient of D is not zero. The law starts in the steady state at r = `reference` if D(0) ≠ 0, otherwise from
  /// zero. `states`, if given, replaces these initial states.
  static ControlLaw transfer_function(std::vector<double> numerator, std::vector<double> denominator, double reference,
                                      bool by_rate, const std::vector<double>& states);
};

}  // namespace engrane::elements::control
