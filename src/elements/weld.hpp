// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "elements/joint_card.hpp"

namespace engrane {

/// WELD (ENCASTREMENT): node B keeps its place and orientation relative to node A.
ElementType weld_type();

}  // namespace engrane
