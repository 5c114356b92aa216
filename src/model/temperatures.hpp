// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <unordered_map>

#include "model/function.hpp"

namespace engrane {

/// Temperature rise of a node above the reference configuration, in which bodies are free of stress.
struct Warmth {
  double rise = 0;
  const Function* function = nullptr;  ///< factor as a function of time

  double at(double time) const { return rise * (function ? function->at(time).f : 1); }
  double rate(double time) const { return function ? rise * function->at(time).d1 : 0; }
};

/// By node number; other nodes are at reference temperature.
using Temperatures = std::unordered_map<int, Warmth>;

}  // namespace engrane
