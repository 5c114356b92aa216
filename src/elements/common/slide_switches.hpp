// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "model/element.hpp"

namespace engrane::elements {

/// Adds a friction that is regularised near zero speed, and the switch at its regularisation speed: below it friction changes
/// from one direction to the other in so short a time that steps may pass over it. Before the switches of grips.
inline void name_slide(Layout& layout, const std::string& where) {
  layout.switches.push_back({where + "slides faster than VREG", where + "slides slower than VREG", true});
  ++layout.slides;
}

/// Values of these switches, in the order in which they were added.
inline void slide_switches(const Element& element, const State& state, std::span<Switch> values) {
  std::vector<Vec3> speeds(values.size());
  element.sliding(state, speeds);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double speed = speeds[i].norm();
    values[i] = {speed - 1, std::numeric_limits<double>::quiet_NaN(), speed + 1};
  }
}

}  // namespace engrane::elements
