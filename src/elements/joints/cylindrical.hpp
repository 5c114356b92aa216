// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "elements/joints/joint_card.hpp"

namespace engrane::elements::joints {

/// CYLINDRICAL (CYLINDRIQUE): node B slides along an axis fixed to node A and turns about it.
ElementType cylindrical_type();

}  // namespace engrane::elements::joints
