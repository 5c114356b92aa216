// SPDX-License-Identifier: BSD-3-Clause
// The geometry of a gear pair from its design data, checked against the node positions.
#pragma once

#include <optional>

#include "elements/gears/gear_card.hpp"
#include "elements/gears/gear_geometry.hpp"
#include "model/registry.hpp"

namespace engrane::elements::gears {

/// The pair's geometry in the paper's conventions.
struct GearPlacement {
  GearDesign design;
  PitchFrames frames;
};

/// Geometry consistent with the node positions and, where given, the pitch radii and the axle of B. Returns nothing, with
/// errors, if there is none.
std::optional<GearPlacement> place_gear(const GearData& data, const BuildContext& context);

/// Position that `PLACE` gives to the node of wheel B; nothing without `PLACE`. Must be called before node positions are used.
std::optional<NodePlacement> place_second_wheel(const GearData& data, const BuildContext& context);

}  // namespace engrane::elements::gears
