// SPDX-License-Identifier: BSD-3-Clause
#include "elements/gears/tooth_relief.hpp"

#include <cmath>

#include "elements/gears/mesh_stiffness.hpp"

namespace engrane::elements::gears {

Function::Jet ToothRelief::lacking(double place) const {
  Function::Jet sum;
  for (const Ramp& r : ramps) {
    const double side = r.at_recess ? 1 : -1;
    const double s = (side * place - (r.at_recess ? recess : approach)) / r.length + 1;  // 0 at its start, 1 at the end
    if (s <= 0) continue;
    const double p = r.exponent, slope = side / r.length;
    sum.f += r.amount * std::pow(s, p);
    sum.d1 += r.amount * p * std::pow(s, p - 1) * slope;
    if (p > 1) sum.d2 += r.amount * p * (p - 1) * std::pow(s, p - 2) * slope * slope;
  }
  return sum;
}

Function::Jet ToothRelief::present(double place) const {
  const Function::Jet up = smooth_step(place + approach, edge), down = smooth_step(recess - place, edge);
  return {up.f * down.f, up.d1 * down.f - up.f * down.d1, up.d2 * down.f - 2 * up.d1 * down.d1 + up.f * down.d2, 0};
}

}  // namespace engrane::elements::gears
