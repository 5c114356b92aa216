// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>

#include "deck/cards/cards.hpp"

namespace engrane::deck {

/// `.INI DEP|VIT` with its alternatives to nodal components: `ELEMENT n V value`, the coordinate of a joint, and
/// `GROUP g AXIS x y z AT x y z V value`, rigid rotation of nodes about an axis.
struct InitialMotionCard : InitialCard {
  std::optional<int> element;
  std::string coordinate;  ///< of the element, by channel name; empty: its first
  std::optional<std::array<double, 3>> axis;
  std::optional<std::array<double, 3>> at;  ///< a point on the axis; none: the origin
};

}  // namespace engrane::deck
