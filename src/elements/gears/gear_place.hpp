// SPDX-License-Identifier: BSD-3-Clause
// From what a designer knows of a gear pair to its geometry, checked against the places of the nodes.
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

/// Geometry that agrees with the places of the nodes, and with the pitch radii and the axle of B where given. Faults go to
/// the context's diagnostics; then there is no result.
std::optional<GearPlacement> place_gear(const GearData& data, const BuildContext& context);

/// Where `PLACE` puts the node of wheel B; nothing without it. To be asked before anything looks at the nodes.
std::optional<NodePlacement> place_second_wheel(const GearData& data, const BuildContext& context);

}  // namespace engrane::elements::gears
