// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "elements/joints/joint_card.hpp"

namespace engrane::elements::joints {

/// WELD (ENCASTREMENT): node B keeps its position and orientation relative to node A.
ElementType weld_type();

}  // namespace engrane::elements::joints
