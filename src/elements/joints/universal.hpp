// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "elements/joints/joint_card.hpp"

namespace engrane::elements::joints {

/// UNIVERSAL (CARDAN): two shafts joined by a cross of perpendicular pins, one fixed to each.
ElementType universal_type();

}  // namespace engrane::elements::joints
