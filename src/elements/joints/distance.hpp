// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "elements/joints/joint_card.hpp"

namespace engrane::elements::joints {

/// DISTANCE: a massless rod of constant or driven length between a point of A and a point of B.
ElementType distance_type();

}  // namespace engrane::elements::joints
