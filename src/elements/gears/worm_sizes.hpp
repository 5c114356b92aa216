// SPDX-License-Identifier: BSD-3-Clause
// Sizes of a worm drive from any two that fix it.
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace engrane::elements::gears {

/// Threads, teeth and the angle between the axles (radians).
struct WormNumbers {
  int starts = 1, teeth = 1;
  double shaft_angle = 0;
};

/// A size of a worm drive, by its keyword.
enum class WormSize { lead_angle, quotient, normal_module, axial_module, lead, diameter, center_distance };
inline constexpr std::array<std::string_view, 7> worm_keywords{"LAMBDA", "Q", "MN", "MX", "LEAD", "DIAMETER", "DISTANCE"};

/// What a worm of normal module 1 and lead angle λ has of a length; of the angle and the quotient, their value.
double worm_size(WormSize size, const WormNumbers& numbers, double lead_angle);

/// Is it a length, so that it fixes the module as well?
constexpr bool is_length(WormSize size) { return size != WormSize::lead_angle && size != WormSize::quotient; }

/// The lead angle, radians, from two sizes: λ itself, q = z₁/tanλ, or the ratio of two lengths. Where two lead angles give the
/// same ratio (a centre distance with the normal module), the smaller. Nothing when none does.
std::optional<double> worm_lead_angle(const WormNumbers& numbers, WormSize one, double value, WormSize other, double other_value);

}  // namespace engrane::elements::gears
