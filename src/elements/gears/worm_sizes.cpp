// SPDX-License-Identifier: BSD-3-Clause
#include "elements/gears/worm_sizes.hpp"

#include <cmath>
#include <numbers>
#include <utility>

namespace engrane::elements::gears {

double worm_size(WormSize size, const WormNumbers& numbers, double lead_angle) {
  const double s = std::sin(lead_angle), c = std::cos(lead_angle), starts = numbers.starts;
  switch (size) {
    case WormSize::lead_angle:
      return lead_angle;
    case WormSize::quotient:
      return starts * c / s;
    case WormSize::normal_module:
      return 1;
    case WormSize::axial_module:
      return 1 / c;
    case WormSize::lead:
      return std::numbers::pi * starts / c;
    case WormSize::diameter:
      return starts / s;
    case WormSize::center_distance:
      // the wheel's helix angle is the shaft angle less that of the worm, 90° − λ
      return 0.5 * (starts / s + numbers.teeth / std::cos(numbers.shaft_angle - std::numbers::pi / 2 + lead_angle));
  }
  return 0;
}

std::optional<double> worm_lead_angle(const WormNumbers& numbers, WormSize one, double value, WormSize other,
                                      double other_value) {
  if (!is_length(one)) std::swap(one, other), std::swap(value, other_value);
  if (!is_length(other)) return other == WormSize::lead_angle ? other_value : std::atan2(numbers.starts, other_value);
  const auto excess = [&](double angle) {
    return worm_size(one, numbers, angle) * other_value - worm_size(other, numbers, angle) * value;
  };
  // first change of sign from small lead angles upwards, then bisection to the last digit
  constexpr double step = std::numbers::pi / 2 / 4000;
  double low = 1e-6, f_low = excess(low);
  for (double high = step; high < std::numbers::pi / 2; high += step) {
    if (std::cos(numbers.shaft_angle - std::numbers::pi / 2 + high) < 1e-3) break;  // the wheel's helix would pass 90°
    const double f_high = excess(high);
    if (f_low == 0) return low;
    if ((f_low < 0) != (f_high < 0)) {
      for (int i = 0; i < 200; ++i) {
        const double middle = 0.5 * (low + high);
        if (middle == low || middle == high) break;
        ((excess(middle) < 0) == (f_low < 0) ? low : high) = middle;
      }
      return 0.5 * (low + high);
    }
    low = high;
    f_low = f_high;
  }
  return {};
}

}  // namespace engrane::elements::gears
