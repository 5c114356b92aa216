// SPDX-License-Identifier: BSD-3-Clause
#include "model/grip.hpp"

#include <cmath>
#include <limits>
#include <vector>

namespace engrane {

void add_grip(Layout& layout, Named named, const std::string& where) {
  layout.multipliers.push_back({std::move(named), Role::grip});
  layout.switches.push_back({where + "slides", where + "comes to rest"});
  layout.switches.push_back({where + "holds", where + "breaks away"});
  layout.history += GripState::history;
  ++layout.grips;
}

std::vector<GripState> unfollowed_grips(const Element& element) {
  const Layout& layout = element.layout();
  std::vector<double> scalars(layout.scalars.size()), history(static_cast<std::size_t>(layout.history));
  element.start(scalars, history);
  std::vector<GripState> states;
  for (int i = 0; i < layout.grips; ++i) states.push_back(GripState::of(history, layout.grips, i));
  return states;
}

void find_grips(const Element& element, const State& state, std::span<Grip> grips) {
  const Layout& layout = element.layout();
  const std::size_t count = layout.multipliers.size(), first = static_cast<std::size_t>(layout.first_grip());
  std::vector<double> phi(count), rate(count), second(count), limits(grips.size());
  element.constraint_rates(state, phi, rate, second);
  element.grip_limits(state, limits);
  for (std::size_t i = 0; i < grips.size(); ++i) {
    const std::size_t m = first + i;
    const bool length = layout.multipliers[m].dimension == dimension::length;
    double speeds = std::abs(rate[m]), accelerations = std::abs(second[m]);
    for (std::size_t n = 0; n < state.nodes.size(); ++n) {
      speeds += (length ? state.nodes[n].v : state.nodes[n].W).norm();
      accelerations += (length ? state.nodes[n].a : state.nodes[n].A).norm();
    }
    grips[i] = {GripState::of(state.history, layout.grips, static_cast<int>(i)),
                phi[m],
                rate[m],
                second[m],
                state.multipliers[m],
                limits[i],
                speeds,
                accelerations};
  }
}

void grip_switches(const Element& element, const State& state, std::span<Switch> values) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN(), least = std::numeric_limits<double>::min();
  const auto count = static_cast<std::size_t>(element.layout().grips);
  if (count == 0) return;
  std::vector<Grip> grips(count);
  find_grips(element, state, grips);
  for (std::size_t i = 0; i < count; ++i) {
    const Grip& grip = grips[i];
    const int direction = grip.state.direction();
    values[2 * i] =
        direction == 0 ? Switch{} : Switch{direction * grip.speed, direction * grip.acceleration, grip.speeds + least};
    // no element knows the rate of a multiplier
    values[2 * i + 1] = grip.state.mode != GripState::holding
                            ? Switch{}
                            : Switch{grip.limit - std::abs(grip.force), unknown, grip.limit + std::abs(grip.force) + least};
  }
}

}  // namespace engrane
