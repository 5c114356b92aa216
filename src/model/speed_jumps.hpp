// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "model/jump.hpp"
#include "model/model.hpp"

namespace engrane {

/// A drive or a support whose imposed speed jumps, as a displacement by a TABLE does at its corners.
struct SpeedJump {
  const Model::Part* drive = nullptr;  ///< nullptr: a support
  int node = 0;                        ///< of the support, as in Support
  double change = 0;                   ///< of the speed; [length/time] or [rad/time]
  Dimension dimension;                 ///< of `change`
};

/// The speeds that drives and supports impose at `time`, always in the same order.
std::vector<ValueAndRate> imposed_speeds(const Model& model, double time);

/// The first imposed speed in the deck that jumps from the number before `time` to `time` itself. It takes an impulse, which
/// changes all velocities as an impact without rebound does.
std::optional<SpeedJump> speed_jump(const Model& model, double time);
/// The first that differs at `time` from those that the motion has had `before`.
std::optional<SpeedJump> speed_jump(const Model& model, double time, const std::vector<ValueAndRate>& before);

/// Whether an imposed acceleration jumps there, as that of a drive whose speed begins to grow does.
bool imposed_acceleration_jumps(const Model& model, double time);

}  // namespace engrane
