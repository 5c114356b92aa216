// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "base/diagnostics.hpp"
#include "model/model.hpp"

namespace engrane {

/// Reports supports that move a component that their node does not have, and rotations that are no motion of it. All three
/// rotations of a node may be prescribed, of which one may be other than zero, or two (it then turns about the third axis).
/// Single components of a finite rotation, and several that change, have no meaning. `locations`: of Model::supports, in order.
void check_supports(const Model& model, std::span<const Location> locations, Diagnostics& diagnostics);

/// Reports nodal loads on components that their node does not have, once for a record, unless a support takes them.
void check_nodal_loads(const Model& model, Diagnostics& diagnostics);

/// Reports stops that need the rotation of a node to which only stops give one: nothing would hold it. `.CLM FIX` may.
void check_stops(const Model& model, Diagnostics& diagnostics);

/// Reports initial values of components that their node does not have, once for a record. `locations`: of Model::initial, in
/// order.
void check_initial_values(const Model& model, std::span<const Location> locations, Diagnostics& diagnostics);

}  // namespace engrane
