// SPDX-License-Identifier: BSD-3-Clause
// Linear laws of control in state space, with their start.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace engrane::elements::control {

/// From reference r and measured value m to the command y:
///
///     dx/dt = A x + b_r r + b_m m + b_v dm/dt,   y = c x + d_r r + d_m m
///
/// States are in units of y. A law that starts from a steady state takes m through its rate: then its states do not depend on
/// where the mechanism happens to stand, and their steady start is known before it is assembled.
struct ControlLaw {
  static constexpr int most_states = 6;

  Eigen::MatrixXd A;
  Eigen::VectorXd b_r, b_m, b_v, c;
  double d_r = 0, d_m = 0;
  Eigen::VectorXd pace;   ///< of each state: an inverse time of its own scale, to write its row in units of y
  Eigen::VectorXd start;  ///< states at the start
  int integral = -1;      ///< the state that takes the anti-windup; -1: none

  int order() const { return static_cast<int>(A.rows()); }

  explicit ControlLaw(int order);

  struct Pid {
    double proportional = 0, integral = 0, derivative = 0;
    double filter = 0;          ///< time constant of the derivative
    double integral_start = 0;  ///< of the integral's part of y
  };
  /// y = KP e + KI ∫e dt + KD s/(1 + filter s) e with e = r − m. `reference` is r at the start, where the derivative begins at
  /// zero; `by_rate`: dm/dt is known.
  static ControlLaw pid(const Pid& gains, double reference, bool by_rate);

  /// y = N(s)/D(s) e, coefficients from the highest power down as in MATLAB, N of no higher degree than D, the first of D not
  /// zero. It starts steady at r = `reference` where D(0) is not zero, otherwise from zero; `states` replaces that start.
  static ControlLaw transfer_function(std::vector<double> numerator, std::vector<double> denominator, double reference,
                                      bool by_rate, const std::vector<double>& states);
};

}  // namespace engrane::elements::control
