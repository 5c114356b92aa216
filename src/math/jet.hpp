// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace engrane {

/// Value and first three derivatives of a function of one variable at one point.
struct Jet {
  double f = 0;
  double d1 = 0;
  double d2 = 0;
  double d3 = 0;
};

/// Jet of x ↦ f(rate·x), given the jet of f at rate·x.
inline Jet stretched(const Jet& j, double rate) { return {j.f, rate * j.d1, rate * rate * j.d2, rate * rate * rate * j.d3}; }

}  // namespace engrane
