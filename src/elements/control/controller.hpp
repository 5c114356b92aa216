// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/registry.hpp"

namespace engrane::elements::control {

/// Card of a controller. `CONTROLLER IN i [COORDINATE name] [QUANTITY SPEED] [REF r] [NF f] law OUT j [ALONG name]
/// [DRIVE SPEED|POSITION TAU t] [LIMITS low high]` with the law `KP p [KI i] [KD d]` or `NUM … DEN …`.
struct ControllerData {
  int input = 0;
  std::string coordinate;
  deck::Tagged quantity;            ///< VALUE or SPEED
  std::optional<double> reference;  ///< degrees where the input is an angle; with a function alone: 1 radian
  int function = 0;                 ///< multiplies the reference
  double proportional = 0, integral = 0, derivative = 0;
  std::optional<double> filter, integral_start, tracking;
  std::vector<double> numerator, denominator, states;
  std::vector<double> limits;
  int output = 0;
  std::string along;
  deck::Tagged drive;
  std::optional<double> lag;
};

/// CONTROLLER (REGULATEUR): drives a force, a torque or a motion by a PID law or a transfer function.
ElementType controller_type();

}  // namespace engrane::elements::control
