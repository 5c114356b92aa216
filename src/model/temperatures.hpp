// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <unordered_map>

#include "model/function.hpp"

namespace engrane {

/// How much warmer a node is than in the reference configuration, in which bodies are free of stress.
struct Warmth {
  double rise = 0;
  const Function* function = nullptr;  ///< of time, a factor

  double at(double time) const { return rise * (function ? function->at(time).f : 1); }
  double rate(double time) const { return function ? rise * function->at(time).d1 : 0; }
};

/// By the number of the node; the others are as warm as in the reference configuration.
using Temperatures = std::unordered_map<int, Warmth>;

}  // namespace engrane
