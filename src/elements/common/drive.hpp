// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "model/function.hpp"

namespace engrane::elements {

/// A coordinate imposed as a function of time, given as the coordinate itself or as its rate.
struct Drive {
  const Function* function = nullptr;
  bool rate_given = false;  ///< the function is the rate; the coordinate is its integral from t = 0

  bool given() const { return function != nullptr; }

  template <class T>
  T coordinate(const T& time) const {
    return rate_given ? evaluate_integral(*function, time) : evaluate(*function, time);
  }
  double rate(double time) const {
    const Function::Jet j = function->at(time);
    return rate_given ? j.f : j.d1;
  }
};

}  // namespace engrane::elements
