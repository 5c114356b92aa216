// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <numbers>

namespace engrane {

/// One degree in radians. Angles are in degrees in decks and output, in radians internally.
inline constexpr double degree = std::numbers::pi / 180;

/// A whole turn, rad.
inline constexpr double whole_turn = 2 * std::numbers::pi;

}  // namespace engrane
