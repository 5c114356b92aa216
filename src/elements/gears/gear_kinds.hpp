// SPDX-License-Identifier: BSD-3-Clause
// The short forms of GEAR: from what a designer has of a kind of pair to its pitch geometry.
#pragma once

#include <optional>

#include "elements/gears/gear_card.hpp"
#include "elements/gears/gear_geometry.hpp"
#include "model/registry.hpp"

namespace engrane::elements::gears {

/// Where a pair stands. The place of B is known unless the pair itself is to find it (`PLACE`).
struct GearSite {
  Vec3 x_a = Vec3::Zero();
  std::optional<Vec3> x_b;
  Vec3 axle = Vec3::UnitZ();  ///< μ₁, of length 1
};

/// Numbers of teeth, from Z and STARTS. Of parallel axles Z may have one value where module, helix and centre distance (DISTANCE,
/// or of the nodes) are known: wheel B has the teeth with which they close, profile shifts considered. An error when one is
/// missing or no whole number fits.
std::optional<std::array<int, 2>> gear_teeth_numbers(const GearData& data, const GearSite& site, const BuildContext& context);

/// The design of a card with `KIND`. Data that are missing, that contradict each other or that the kind does not take go to
/// the context's diagnostics; then there is no result.
std::optional<GearDesign> design_of_kind(const GearData& data, const GearSite& site, const BuildContext& context);

/// Cones of a pair whose axles meet at the angle `shaft`: their sign is the one that suits the side of A on which B lies,
/// positive where B is still to be placed.
std::array<double, 2> bevel_cones(double shaft, const std::array<int, 2>& teeth, const GearSite& site);

/// Without `KIND`: are there keywords that only the short forms know? Then an error.
bool check_long_form(const GearData& data, const BuildContext& context);

}  // namespace engrane::elements::gears
