// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "elements/joints/joint_card.hpp"

namespace engrane::elements::joints {

/// CONSTANT_VELOCITY (HOMOCINETIQUE): two shafts that meet in a point turn by the same angle, whatever the angle between them.
ElementType constant_velocity_type();

}  // namespace engrane::elements::joints
