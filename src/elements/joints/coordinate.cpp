// SPDX-License-Identifier: BSD-3-Clause
#include "elements/joints/coordinate.hpp"

namespace engrane::elements::joints {

void Coordinate::commit(const NodeState& a, const NodeState& b, std::span<const double> committed, std::span<double> next) const {
  if (!is_angle()) return;
  turn_count::commit(measure(what, frame, JointPose<double>(frame, a, b)).value, committed, next);
}

}  // namespace engrane::elements::joints
