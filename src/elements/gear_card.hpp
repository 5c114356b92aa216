// SPDX-License-Identifier: BSD-3-Clause
// The card GEAR: what a designer knows of a gear pair, and how geometry and tooth law follow from it.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "elements/gear_geometry.hpp"
#include "elements/gear_teeth.hpp"
#include "model/registry.hpp"

namespace engrane {

/// `I id GEAR …`, as the deck gives it: angles in degrees, helices in the trade's sign.
struct GearData {
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
  std::optional<double> width;
  std::optional<double> stiffness;
  std::optional<double> damping_ratio;
  std::optional<double> damping;
  deck::Tagged damping_mode;
  std::optional<double> backlash;
  std::optional<double> onset;
  deck::Tagged error;
  deck::Tagged separation{"YES", {}};
};

const deck::Card<GearData>& gear_card();

/// The pair's geometry in the paper's conventions, checked against the places of the nodes and the pitch radii given.
/// Faults go to the context's diagnostics; then there is no result.
struct GearPlacement {
  GearDesign design;
  PitchFrames frames;
};
std::optional<GearPlacement> place_gear(const GearData& data, const BuildContext& context);

/// The tooth law; rigid teeth, without `KM`, have stiffness 0. Faults go to the context's diagnostics; then there is no result.
std::optional<ToothLaw> tooth_law(const GearData& data, const GearPlacement& placement, const BuildContext& context);

}  // namespace engrane
