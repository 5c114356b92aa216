// SPDX-License-Identifier: BSD-3-Clause
// Do the joints of a deck let the wheels of a gear pair turn about their axles?
#pragma once

#include <array>

#include "math/vector.hpp"
#include "model/registry.hpp"

namespace engrane::elements::gears {

/// An error, and false, where joints hold both wheels to one body, so that the pair cannot follow, and let one turn about a
/// direction that is more than a degree away from its axle: hands of helices that make crossed axles of parallel bearings, or an
/// AXIS of the joint that slipped. A wheel that is itself that body counts as held. `nodes` and `axles` are those of wheel A
/// and B, unit vectors in the reference configuration; a zero axle is that of a rack, which has none.
///
/// What a joint lets turn is read from its constraints, whatever its kind: the null space of their gradient by the motion of the
/// wheel's node, drives left out, where the angular parts of all null vectors lie along one direction.
bool check_bearings(const std::array<int, 2>& nodes, const std::array<Vec3, 2>& axles, const BuildContext& context);

}  // namespace engrane::elements::gears
