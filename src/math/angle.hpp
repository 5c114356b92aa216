// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <numbers>

namespace engrane {

/// In radians: angles are in degrees where a person reads or writes them, in radians inside.
inline constexpr double degree = std::numbers::pi / 180;

}  // namespace engrane
