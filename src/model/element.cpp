// SPDX-License-Identifier: BSD-3-Clause
#include "model/element.hpp"

#include <algorithm>

namespace engrane {

void Element::start(std::span<double> scalars, std::span<double> history) const {
  std::fill(scalars.begin(), scalars.end(), 0.0);
  std::fill(history.begin(), history.end(), 0.0);
}

void Element::count_turns(const State& state, std::span<double>, std::span<double> history) const {
  std::copy(state.history.begin(), state.history.end(), history.begin());
}

void Element::commit(const State& state, std::span<double> scalars, std::span<double> history) const {
  count_turns(state, scalars, history);
}

void Element::switches(const State&, std::span<Switch>) const {}

bool Element::touches(const State& state) const {
  std::vector<Switch> values(layout().switches.size());
  switches(state, values);
  return std::any_of(values.begin(), values.end(), [](const Switch& s) { return s.unclear(); });
}

void Element::sliding(const State&, std::span<Vec3>) const {}

void Element::grip_limits(const State&, std::span<double>) const {}

Energies Element::energies(const State&) const { return {}; }

Mat3 Element::inertia_at(int) const { return Mat3::Zero(); }

const std::vector<Channel>& Element::channels() const {
  static const std::vector<Channel> none;
  return none;
}

void Element::observe(const State&, std::span<double>) const {}

const std::vector<Field>& Element::fields() const {
  static const std::vector<Field> none;
  return none;
}

void Element::evaluate_fields(const State&, std::span<double>) const {}

std::vector<Release> Element::releases() const {
  std::vector<Release> all;
  const auto& multipliers = layout().multipliers;
  for (std::size_t i = 0; i < multipliers.size(); ++i) {
    if (multipliers[i].role == Role::drive) all.push_back({"leave out the drive of {}", {static_cast<int>(i)}, ""});
    if (multipliers[i].role == Role::tooth) all.push_back({"give {} a tooth stiffness (KM)", {static_cast<int>(i)}, ""});
  }
  return all;
}

std::vector<Derived> Element::derived() const { return {}; }

Drawing Element::drawing() const { return {}; }

}  // namespace engrane
