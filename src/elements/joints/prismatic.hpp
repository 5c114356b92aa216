// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "elements/joints/joint_card.hpp"

namespace engrane::elements::joints {

/// PRISMATIC (PRISMATIQUE): node B slides along an axis fixed to node A without rotating relative to it.
ElementType prismatic_type();

}  // namespace engrane::elements::joints
