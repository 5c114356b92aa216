// SPDX-License-Identifier: BSD-3-Clause
// The card GEAR: design data of a gear pair. gear_place.hpp derives the geometry from it, teeth_card.hpp the tooth law.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "elements/gears/cut_card.hpp"
#include "elements/gears/teeth_card.hpp"

namespace engrane::elements::gears {

/// `I id GEAR …` as given in the deck: angles in degrees, helices positive for right hand.
struct GearData : TeethData, CutData {
  std::array<int, 2> nodes{0, 0};
  std::vector<int> teeth;  ///< of A and B; with `starts` one value, of the worm wheel
  std::optional<double> normal_module;
  double pressure_angle = 20;
  std::vector<double> helix;                  ///< one value: wheel A's, that of B follows; none: straight teeth
  std::optional<std::array<double, 2>> cone;  ///< with the paper's sign
  std::optional<double> shaft_angle;
  bool internal = false;
  std::array<double, 3> axis{0, 0, 0};
  std::optional<std::array<double, 3>> axis_b;
  std::optional<std::array<double, 2>> radii;
  std::optional<std::array<double, 3>> place;  ///< from the centre of A towards the contact point; positions B

  // data of the short forms (gear_kinds.hpp)
  deck::Tagged kind;
  deck::Tagged hand;
  std::optional<double> transverse_module, axial_module;
  std::optional<double> center_distance, diameter, offset, ring_cone;
  std::optional<int> starts;
  std::optional<double> lead_angle, lead, quotient;
};

const deck::Card<GearData>& gear_card();

}  // namespace engrane::elements::gears
