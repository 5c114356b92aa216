// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "assembly/configuration.hpp"

namespace engrane {

/// Returns the motion from `from` to `to`, in the order of the motion slots: six per node, including the ground (translation,
/// then the rotation vector from the old to the new orientation, in material components, of length at most π), then the scalars
/// of the elements. Moving `from` by it (MotionSlots::move in solve) gives `to` up to rounding. Both must belong to the same
/// model.
std::vector<double> difference(const Configuration& to, const Configuration& from);

}  // namespace engrane
