// SPDX-License-Identifier: BSD-3-Clause
// The short forms of GEAR: pitch geometry from the usual design data of a kind of pair.
#pragma once

#include <optional>

#include "elements/gears/gear_card.hpp"
#include "elements/gears/gear_geometry.hpp"
#include "model/registry.hpp"

namespace engrane::elements::gears {

/// Location of a pair. The position of B is known unless the pair itself determines it (`PLACE`).
struct GearSite {
  Vec3 x_a = Vec3::Zero();
  std::optional<Vec3> x_b;
  Vec3 axle = Vec3::UnitZ();  ///< μ₁, of length 1
};

/// Numbers of teeth from Z and STARTS. For parallel axles Z may have one value if module, helix and centre distance (DISTANCE,
/// or that of the nodes) are known: wheel B gets the number of teeth that closes the pair, including profile shift. Reports an
/// error if a number is missing or no integer fits.
std::optional<std::array<int, 2>> gear_teeth_numbers(const GearData& data, const GearSite& site, const BuildContext& context);

/// The design of a card with `KIND`. Returns nothing, with errors, if data are missing, contradictory, or not accepted by the
/// kind.
std::optional<GearDesign> design_of_kind(const GearData& data, const GearSite& site, const BuildContext& context);

/// Cone angles of a pair whose axles intersect at the angle `shaft`. Their sign follows from the side of A on which B lies; it
/// is positive if B is not yet placed.
std::array<double, 2> bevel_cones(double shaft, const std::array<int, 2>& teeth, const GearSite& site);

/// Without `KIND`: reports an error if keywords of the short forms are given.
bool check_long_form(const GearData& data, const BuildContext& context);

}  // namespace engrane::elements::gears
