// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "model/function.hpp"

namespace engrane::test {

/// Slope by differences of order six.
inline double slope(const std::function<double(double)>& f, double x, double h) {
  return (45 * (f(x + h) - f(x - h)) - 9 * (f(x + 2 * h) - f(x - 2 * h)) + (f(x + 3 * h) - f(x - 3 * h))) / (60 * h);
}

/// The derivatives of a jet are those of its value, slope and curvature.
inline void expect_jet(const std::function<Function::Jet(double)>& f, double x, double h, double tolerance) {
  const Function::Jet j = f(x);
  EXPECT_NEAR(j.d1, slope([&](double t) { return f(t).f; }, x, h), tolerance * (1 + std::abs(j.d1)));
  EXPECT_NEAR(j.d2, slope([&](double t) { return f(t).d1; }, x, h), tolerance * (1 + std::abs(j.d2)));
  EXPECT_NEAR(j.d3, slope([&](double t) { return f(t).d2; }, x, h), tolerance * (1 + std::abs(j.d3)));
}

}  // namespace engrane::test
