// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "elements/joints/joint_card.hpp"

namespace engrane::elements::joints {

/// SCREW (VIS): node B turns about an axis fixed to node A and advances by a pitch per turn.
ElementType screw_type();

}  // namespace engrane::elements::joints
