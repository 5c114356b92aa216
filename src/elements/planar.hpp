// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "elements/joint_card.hpp"

namespace engrane {

/// PLANAR (PLAN): node B slides on a plane held by node A and turns about its normal.
ElementType planar_type();

}  // namespace engrane
