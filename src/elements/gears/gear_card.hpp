// SPDX-License-Identifier: BSD-3-Clause
// The card GEAR: what a designer knows of a gear pair. gear_place.hpp makes geometry of it, teeth_card.hpp the tooth law.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "elements/gears/cut_card.hpp"
#include "elements/gears/teeth_card.hpp"

namespace engrane::elements::gears {

/// `I id GEAR …`, as the deck gives it: angles in degrees, helices in the trade's sign.
struct GearData : TeethData, CutData {
  std::array<int, 2> nodes{0, 0};
  std::vector<int> teeth;  ///< of A and B; one value with `starts`: of the worm wheel
  std::optional<double> normal_module;
  double pressure_angle = 20;
  std::vector<double> helix;                  ///< one value: of wheel A, B is made to fit; none: straight teeth
  std::optional<std::array<double, 2>> cone;  ///< in the paper's sign
  std::optional<double> shaft_angle;
  bool internal = false;
  std::array<double, 3> axis{0, 0, 0};
  std::optional<std::array<double, 3>> axis_b;
  std::optional<std::array<double, 2>> radii;
  std::optional<std::array<double, 3>> place;  ///< from the centre of A towards the contact point; B is put where it closes

  // what a short form may give instead (gear_kinds.hpp)
  deck::Tagged kind;
  deck::Tagged hand;
  std::optional<double> transverse_module, axial_module;
  std::optional<double> center_distance, diameter, offset, ring_cone;
  std::optional<int> starts;
  std::optional<double> lead_angle, lead, quotient;
};

const deck::Card<GearData>& gear_card();

}  // namespace engrane::elements::gears
