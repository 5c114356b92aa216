// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "math/taylor.hpp"
#include "model/templated_element.hpp"

namespace engrane::elements {

/// Two nodes along the motion in `state`, to second order in time: positions and orientations.
std::array<Motion<Taylor, 2>::Node, 2> along_motion(const State& state);

}  // namespace engrane::elements
