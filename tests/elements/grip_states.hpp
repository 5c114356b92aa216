// SPDX-License-Identifier: BSD-3-Clause
// States of frictions that can rest, for the suite.
#pragma once

#include "elements/suite.hpp"
#include "model/grip.hpp"

namespace engrane::suite {

/// Puts all grips of the subject's states, beside what is done to these already, into a mode: sliding anywhere, where their
/// multipliers are zero, or held somewhere.
inline void put_grips(Subject& s, const Layout& layout, GripState::Mode mode) {
  s.adjust = [=, before = s.adjust](StateBuffer& state, Random& random) {
    if (before) before(state, random);
    for (std::size_t i = 0; i < layout.grips.size(); ++i) {
      GripState grip;
      grip.mode = mode;
      for (Eigen::Index k = 0; k < layout.grips[i].size; ++k) {
        grip.held[k] = 0.3 * uniform(random);
        grip.direction[k] = uniform(random);
      }
      grip.direction.normalize();
      grip.speed = 2 + uniform(random);  // so that some states are near enough to rest to count as such
      grip.write(layout, state.history, i);
    }
    for (auto m = static_cast<std::size_t>(layout.grip_row()); m < layout.multipliers.size() && mode != GripState::holding; ++m)
      state.multipliers[m] = 0;
  };
  for (const Check check : {Check::rigid, Check::zero}) s.skip[check] = "it acts at any speed, or holds another place";
}

}  // namespace engrane::suite
