// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "elements/joints/joint_card.hpp"

namespace engrane::elements::joints {

/// POINT_CYLINDER (POINT_CYLINDRE): a point of node B stays on a cylinder fixed to node A.
ElementType point_cylinder_type();

}  // namespace engrane::elements::joints
