// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "elements/joints/joint_card.hpp"

namespace engrane::elements::joints {

/// POINT_PLANE (POINT_PLAN): a point of node B stays on a plane fixed to node A.
ElementType point_plane_type();

}  // namespace engrane::elements::joints
