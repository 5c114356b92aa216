// SPDX-License-Identifier: BSD-3-Clause
#include "elements/control/control_law.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace engrane::elements::control {

ControlLaw::ControlLaw(int order) {
  A = Eigen::MatrixXd::Zero(order, order);
  b_r = b_m = b_v = c = pace = start = Eigen::VectorXd::Zero(order);
}

ControlLaw ControlLaw::pid(const Pid& gains, double reference, bool by_rate) {
  const bool integral = gains.integral != 0, derivative = gains.derivative != 0;
  ControlLaw law(static_cast<int>(integral) + static_cast<int>(derivative));
  law.d_r = gains.proportional;
  law.d_m = -gains.proportional;
  int i = 0;
  if (integral) {
    law.integral = i;
    law.b_r[i] = gains.integral;
    law.b_m[i] = -gains.integral;
    law.c[i] = 1;
    law.pace[i] = gains.proportional != 0 ? std::abs(gains.integral / gains.proportional) : 1;
    law.start[i] = gains.integral_start;
    ++i;
  }
  if (derivative) {
    // w = KD/filter times the filtered error; the derivative part of y is KD/filter e − w
    const double high = gains.derivative / gains.filter;
    law.A(i, i) = -1 / gains.filter;
    law.pace[i] = 1 / gains.filter;
    law.c[i] = -1;
    law.d_r += high;
    law.b_r[i] = high / gains.filter;
    law.start[i] = high * reference;
    if (by_rate) {
      // the state is w + high m instead of w: in steady state it equals high r, whatever m is
      law.b_v[i] = high;
    } else {
      law.b_m[i] = -high / gains.filter;
      law.d_m -= high;
    }
  }
  return law;
}

ControlLaw ControlLaw::transfer_function(std::vector<double> numerator, std::vector<double> denominator, double reference,
                                         bool by_rate, const std::vector<double>& states) {
  // from the lowest power up
  std::reverse(numerator.begin(), numerator.end());
  std::reverse(denominator.begin(), denominator.end());
  const int n = static_cast<int>(denominator.size()) - 1;
  numerator.resize(denominator.size(), 0.0);

  // scale time by the geometric mean of the nonzero poles, so that all coefficients have similar magnitude
  const auto zeros = std::find_if(denominator.begin(), denominator.end(), [](double v) { return v != 0; }) - denominator.begin();
  const double pace = zeros == n ? 1
                                 : std::pow(std::abs(denominator[static_cast<std::size_t>(zeros)] / denominator.back()),
                                            1.0 / static_cast<double>(n - zeros));
  Eigen::VectorXd a(n + 1), b(n + 1);
  for (int k = 0; k <= n; ++k) {
    const double scale = std::pow(pace, k - n) / denominator.back();
    a[k] = denominator[static_cast<std::size_t>(k)] * scale;
    b[k] = numerator[static_cast<std::size_t>(k)] * scale;
  }

  // observer canonical form: y = x_n + b_n e
  ControlLaw law(n);
  Eigen::VectorXd input(n);
  for (int k = 0; k < n; ++k) {
    if (k > 0) law.A(k, k - 1) = pace;
    law.A(k, n - 1) -= pace * a[k];
    input[k] = pace * (b[k] - b[n] * a[k]);
    law.pace[k] = pace;
  }
  if (n > 0) law.c[n - 1] = 1;
  law.b_r = input;
  law.d_r = b[n];
  law.b_m = -input;
  law.d_m = -b[n];
  if (!states.empty()) {
    law.start = Eigen::Map<const Eigen::VectorXd>(states.data(), n);
    return law;
  }
  if (n == 0 || denominator.front() == 0) return law;
  const Eigen::VectorXd steady = -law.A.partialPivLu().solve(input);  // for e = 1
  law.start = steady * reference;
  if (by_rate) {
    // the state is x + steady·m instead of x
    law.b_m.setZero();
    law.b_v = steady;
    law.d_m = -(b[n] + steady[n - 1]);
  }
  return law;
}

}  // namespace engrane::elements::control
