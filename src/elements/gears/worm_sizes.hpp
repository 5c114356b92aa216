// SPDX-License-Identifier: BSD-3-Clause
// Dimensions of a worm drive from any two that determine it.
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace engrane::elements::gears {

/// Numbers of threads and teeth, and the angle between the axles (radians).
struct WormNumbers {
  int starts = 1, teeth = 1;
  double shaft_angle = 0;
};

/// A dimension of a worm drive, with its keyword.
enum class WormSize { lead_angle, quotient, normal_module, axial_module, lead, diameter, center_distance };
inline constexpr std::array<std::string_view, 7> worm_keywords{"LAMBDA", "Q", "MN", "MX", "LEAD", "DIAMETER", "DISTANCE"};

/// Value of a length for a worm with normal module 1 and lead angle λ; for the angle and the quotient, their value.
double worm_size(WormSize size, const WormNumbers& numbers, double lead_angle);

/// Whether it is a length, and so also determines the module.
constexpr bool is_length(WormSize size) { return size != WormSize::lead_angle && size != WormSize::quotient; }

/// Lead angle in radians from two dimensions: λ itself, q = z₁/tanλ, or the ratio of two lengths. If two lead angles give the
/// same ratio (a centre distance with the normal module), the smaller. Returns nothing if there is none.
std::optional<double> worm_lead_angle(const WormNumbers& numbers, WormSize one, double value, WormSize other, double other_value);

}  // namespace engrane::elements::gears
