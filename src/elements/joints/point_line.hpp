// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "elements/joints/joint_card.hpp"

namespace engrane::elements::joints {

/// POINT_LINE (POINT_DROITE): a point of node B stays on a line fixed to node A.
ElementType point_line_type();

}  // namespace engrane::elements::joints
