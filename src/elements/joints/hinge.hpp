// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "elements/joints/joint_card.hpp"

namespace engrane::elements::joints {

/// HINGE (CHARNIERE): node B turns about an axis fixed to node A, through a point fixed to both.
ElementType hinge_type();

}  // namespace engrane::elements::joints
