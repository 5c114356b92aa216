// SPDX-License-Identifier: BSD-3-Clause
// The function of time of the tests of loads.
#pragma once

#include <memory>

#include "elements/suite.hpp"

namespace engrane::elements::loads {

inline suite::FunctionMap waves() {
  suite::FunctionMap functions;
  functions[1] = std::make_unique<suite::Wave>(0.3, 0.7, 1.9, 0.4);
  return functions;
}

inline const suite::FunctionMap functions = waves();

}  // namespace engrane::elements::loads
