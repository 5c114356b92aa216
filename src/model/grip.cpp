// SPDX-License-Identifier: BSD-3-Clause
#include "model/grip.hpp"

#include <algorithm>
#include <limits>

namespace engrane {

namespace {

/// Start of a grip's state in the history.
std::size_t place(const Layout& layout, std::size_t history, std::size_t grip) {
  for (std::size_t i = grip; i < layout.grips.size(); ++i)
    history -= static_cast<std::size_t>(GripState::history(layout.grips[i]));
  return history;
}

}  // namespace

GripState GripState::of(const Layout& layout, std::span<const double> history, std::size_t grip) {
  const auto size = static_cast<std::size_t>(layout.grips[grip].size);
  const double* at = &history[place(layout, history.size(), grip)];
  GripState state;
  state.mode = static_cast<Mode>(static_cast<int>(at[0]));
  state.speed = at[1];
  state.rest = at[2];
  std::copy_n(at + 3, size, state.held.data());
  std::copy_n(at + 3 + size, size, state.direction.data());
  return state;
}

void GripState::write(const Layout& layout, std::span<double> history, std::size_t grip) const {
  const auto size = static_cast<std::size_t>(layout.grips[grip].size);
  double* at = &history[place(layout, history.size(), grip)];
  at[0] = mode;
  at[1] = speed;
  at[2] = rest;
  std::copy_n(held.data(), size, at + 3);
  std::copy_n(direction.data(), size, at + 3 + size);
}

void follow(GripState& grip, const Vec3& u) {
  const double speed = u.norm();
  if (grip.mode != GripState::sliding || speed <= std::max(GripState::halt * grip.speed, grip.rest)) return;
  if (u.dot(grip.direction) <= 0) return;
  grip.direction = u / speed;
  grip.speed = speed;
}

void add_grip(Layout& layout, const std::vector<Named>& named, const GripShape& shape, const std::string& where) {
  for (const Named& multiplier : named) layout.multipliers.push_back({multiplier, Role::grip});
  layout.switches.push_back({where + "slides", where + "comes to rest"});
  layout.switches.push_back({where + "holds", where + "breaks away"});
  layout.history += GripState::history(shape);
  layout.grips.push_back(shape);
}

std::vector<GripState> unfollowed_grips(const Element& element) {
  const Layout& layout = element.layout();
  std::vector<double> scalars(layout.scalars.size()), history(static_cast<std::size_t>(layout.history));
  element.start(scalars, history);
  std::vector<GripState> states;
  for (std::size_t i = 0; i < layout.grips.size(); ++i) states.push_back(GripState::of(layout, history, i));
  return states;
}

void find_grips(const Element& element, const State& state, std::span<Grip> grips) {
  const Layout& layout = element.layout();
  const std::size_t count = layout.multipliers.size();
  std::vector<double> phi(count), rate(count), second(count), limits(grips.size());
  element.constraint_rates(state, phi, rate, second);
  element.grip_limits(state, limits);
  double v = 0, spin = 0, a = 0, turning = 0;
  for (std::size_t n = 0; n < state.nodes.size(); ++n) {
    const NodeState& node = state.nodes[n];
    v += node.v.norm();
    spin += node.W.norm();
    a += node.a.norm();
    turning += node.A.norm();
  }
  auto m = static_cast<std::size_t>(layout.grip_row());
  for (std::size_t i = 0; i < grips.size(); ++i) {
    Grip& grip = grips[i];
    grip = Grip();
    grip.state = GripState::of(layout, state.history, i);
    grip.shape = layout.grips[i];
    grip.limit = limits[i];
    for (Eigen::Index k = 0; k < grip.shape.size; ++k, ++m) {
      const double lever = grip.shape.lever[static_cast<std::size_t>(k)];
      const bool length = layout.multipliers[m].dimension == dimension::length;
      grip.place[k] = phi[m];
      grip.speed[k] = lever * rate[m];
      grip.acceleration[k] = lever * second[m];
      grip.force[k] = state.multipliers[m] / lever;
      grip.speeds += lever * (std::abs(rate[m]) + (length ? v : spin));
      grip.accelerations += lever * (std::abs(second[m]) + (length ? a : turning));
    }
  }
}

void grip_switches(const Element& element, const State& state, std::span<Switch> values) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN(), least = std::numeric_limits<double>::min();
  const std::size_t count = element.layout().grips.size();
  if (count == 0) return;
  std::vector<Grip> grips(count);
  find_grips(element, state, grips);
  for (std::size_t i = 0; i < count; ++i) {
    const Grip& grip = grips[i];
    const bool slides = grip.state.mode == GripState::sliding, holds = grip.state.mode == GripState::holding;
    const Vec3& along = grip.state.direction;
    const double speeds = grip.speeds + grip.state.rest / Switch::rounding + least;
    values[2 * i] = slides ? Switch{along.dot(grip.speed), along.dot(grip.acceleration), speeds} : Switch{};
    // elements do not know the rates of multipliers
    values[2 * i + 1] = holds ? Switch{grip.spare(), unknown, grip.limit + grip.force.norm() + least} : Switch{};
  }
}

}  // namespace engrane
