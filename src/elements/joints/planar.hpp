// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "elements/joints/joint_card.hpp"

namespace engrane::elements::joints {

/// PLANAR (PLAN): node B slides on a plane fixed to node A and turns about its normal.
ElementType planar_type();

}  // namespace engrane::elements::joints
