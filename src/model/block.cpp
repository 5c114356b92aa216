// SPDX-License-Identifier: BSD-3-Clause
#include "model/block.hpp"

#include <algorithm>

namespace engrane {

void Block::start(std::size_t, std::span<double> scalars, std::span<double> history) const {
  std::fill(scalars.begin(), scalars.end(), 0.0);
  std::fill(history.begin(), history.end(), 0.0);
}

void Block::count_turns(std::size_t, const State& state, std::span<double>, std::span<double> history) const {
  std::copy(state.history.begin(), state.history.end(), history.begin());
}

void Block::commit(std::size_t e, const State& state, std::span<double> scalars, std::span<double> history) const {
  count_turns(e, state, scalars, history);
}

Energies Block::energies(std::size_t, const State&) const { return {}; }

Mat3 Block::inertia_at(std::size_t, int) const { return Mat3::Zero(); }

const std::vector<Channel>& Block::channels() const {
  static const std::vector<Channel> none;
  return none;
}

void Block::observe(std::size_t, const State&, std::span<double>) const {}

const std::vector<Field>& Block::fields() const {
  static const std::vector<Field> none;
  return none;
}

void Block::evaluate_fields(std::size_t, const State&, std::span<double>) const {}

std::vector<Derived> Block::derived(std::size_t) const { return {}; }

Drawing Block::drawing(std::size_t) const { return {}; }

}  // namespace engrane
