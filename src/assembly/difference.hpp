// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "assembly/configuration.hpp"

namespace engrane {

/// The motion that leads from `from` to `to`, in the order of the motion slots: six for each node, the ground too (translation,
/// and the rotation vector that turns the old orientation into the new one, in material components, of length at most π), then
/// the elements' scalars. A move of `from` by it (solve's MotionSlots::move) is `to`, to rounding. Both are of one model.
std::vector<double> difference(const Configuration& to, const Configuration& from);

}  // namespace engrane
