// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>

#include "deck/cards/cards.hpp"

namespace engrane::deck {

/// `.INI DEP|VIT` with all that it may speak of beside components of nodes: `ELEMENT n V value`, the coordinate of a joint, and
/// `GROUP g AXIS x y z AT x y z V value`, nodes that turn together about an axis.
struct InitialMotionCard : InitialCard {
  std::optional<int> element;
  std::string coordinate;  ///< of the element, as its channel is named; empty: its first
  std::optional<std::array<double, 3>> axis;
  std::optional<std::array<double, 3>> at;  ///< a point of the axis; none: the origin
};

}  // namespace engrane::deck
