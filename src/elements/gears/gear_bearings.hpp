// SPDX-License-Identifier: BSD-3-Clause
// Checks that the joints of a deck let the wheels of a gear pair turn about their axles.
#pragma once

#include <array>

#include "math/vector.hpp"
#include "model/registry.hpp"

namespace engrane::elements::gears {

/// Reports an error, and returns false, if joints hold both wheels to one body, so that the pair cannot adapt, and one of these
/// joints lets its wheel turn about a direction more than a degree away from its axle. Typical causes are hands of helices that
/// make crossed axles of parallel bearings, or a wrong AXIS of the joint. A wheel that is itself that body counts as held.
/// `nodes` and `axles` are those of wheels A and B, with unit vectors in the reference configuration; the axle of a rack is
/// zero.
///
/// The free rotation is found from a joint's constraints, whatever its kind: from the null space of their gradient with respect
/// to the motion of the wheel's node, without drives, if the angular parts of all null vectors are parallel.
bool check_bearings(const std::array<int, 2>& nodes, const std::array<Vec3, 2>& axles, const BuildContext& context);

}  // namespace engrane::elements::gears
