// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "elements/joints/joint_card.hpp"

namespace engrane::elements::joints {

/// SPHERICAL (ROTULE): nodes A and B have a point in common and turn freely about it.
ElementType spherical_type();

}  // namespace engrane::elements::joints
