// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "model/element.hpp"

namespace engrane::elements {

/// Adds a friction that is regularised near zero speed, and the switches at its regularisation speed: below it friction changes
/// from one direction to the other in so short a time that steps may pass over it. Before the switches of grips. `along_line`:
/// it slides along a single coordinate, and each direction has a switch of its own, of which both change in a step within which
/// the sliding turns round.
inline void name_slide(Layout& layout, const std::string& where, bool along_line) {
  if (along_line) {
    layout.switches.push_back({where + "slides forwards faster than VREG", where + "slides forwards slower than VREG", true});
    layout.switches.push_back({where + "slides backwards slower than VREG", where + "slides backwards faster than VREG", true});
  } else {
    layout.switches.push_back({where + "slides faster than VREG", where + "slides slower than VREG", true});
  }
  ++layout.slides;
}

/// Sets the values of these switches, in the order in which they were added, and returns those behind. `along_line(i)`: of the
/// i-th slide.
template <class AlongLine>
std::span<Switch> slide_switches(const Element& element, const State& state, std::span<Switch> values, AlongLine along_line) {
  const auto slides = static_cast<std::size_t>(element.layout().slides);
  if (slides == 0) return values;
  std::vector<Vec3> speeds(slides), later(slides);
  element.sliding(state, speeds);
  bool any_along_line = false;
  for (std::size_t i = 0; i < slides; ++i) any_along_line = any_along_line || along_line(i);
  if (any_along_line) {
    // sliding is linear in the velocities; that its direction turns with the bodies matters little here
    std::vector<NodeState> nodes;
    for (std::size_t i = 0; i < state.nodes.size(); ++i) {
      nodes.push_back(state.nodes[i]);
      nodes.back().v += nodes.back().a;
      nodes.back().W += nodes.back().A;
    }
    State moved = state;
    moved.nodes = nodes;
    element.sliding(moved, later);
  }
  std::size_t next = 0;
  for (std::size_t i = 0; i < slides; ++i) {
    const double speed = speeds[i].norm();
    if (along_line(i)) {
      const double along = speeds[i][0], rate = later[i][0] - along;
      values[next++] = {along - 1, rate, speed + 1};
      values[next++] = {along + 1, rate, speed + 1};
    } else {
      values[next++] = {speed - 1, std::nan(""), speed + 1};
    }
  }
  return values.subspan(next);
}

}  // namespace engrane::elements
