// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "model/registry.hpp"

namespace engrane::elements::control {

/// Card of a motor. `MOTOR JOINT i [COORDINATE name] CURVE f | STALL t FREE w [RATIO r] [NF f]`
struct MotorData {
  int joint = 0;
  std::string coordinate;             ///< empty: the joint's first
  int curve = 0;                      ///< function of the shaft's speed
  std::optional<double> stall, free;  ///< torque at standstill and no-load speed; a straight line in between
  double ratio = 1;                   ///< of the shaft's speed to the coordinate's rate
  int function = 0;                   ///< function of time that multiplies the torque
};

/// MOTOR (MOTEUR): torque along a joint's coordinate as a function of its speed.
ElementType motor_type();

}  // namespace engrane::elements::control
