// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "math/taylor.hpp"
#include "model/templated_element.hpp"

namespace engrane::elements {

/// A node along its motion, to second order in time: position and orientation, not velocities.
Motion<Taylor, 2>::Node along_motion(const NodeState& state);
/// The two nodes of a state.
std::array<Motion<Taylor, 2>::Node, 2> along_motion(const State& state);

}  // namespace engrane::elements
