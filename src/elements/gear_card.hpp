// SPDX-License-Identifier: BSD-3-Clause
// The card GEAR: what a designer knows of a gear pair. gear_place.hpp makes geometry of it, teeth_card.hpp the tooth law.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "elements/teeth_card.hpp"

namespace engrane {

/// `I id GEAR …`, as the deck gives it: angles in degrees, helices in the trade's sign.
struct GearData : TeethData {
  std::array<int, 2> nodes{0, 0};
  std::array<int, 2> teeth{0, 0};
  double normal_module = 0;
  double pressure_angle = 20;
  std::vector<double> helix;                  ///< one value: of wheel A, B is made to fit; none: straight teeth
  std::optional<std::array<double, 2>> cone;  ///< in the paper's sign
  std::optional<double> shaft_angle;
  bool internal = false;
  std::array<double, 3> axis{0, 0, 0};
  std::optional<std::array<double, 3>> axis_b;
  std::optional<std::array<double, 2>> radii;
};

const deck::Card<GearData>& gear_card();

}  // namespace engrane
