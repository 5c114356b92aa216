// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace engrane {

/// The largest number below x.
inline double number_before(double x) { return std::nextafter(x, -std::numeric_limits<double>::infinity()); }

/// A quantity and its rate.
struct ValueAndRate {
  double value, rate;
};

/// Whether a quantity changes between two neighbouring numbers, `way` apart, by more than its rates and rounding explain.
inline bool jumps(const ValueAndRate& before, const ValueAndRate& after, double way) {
  constexpr double rounding = 1e-12;
  return std::abs(after.value - before.value) > 100 * (std::abs(before.rate) + std::abs(after.rate)) * way +
                                                    rounding * std::max(std::abs(before.value), std::abs(after.value));
}

}  // namespace engrane
