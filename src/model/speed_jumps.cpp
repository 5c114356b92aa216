// SPDX-License-Identifier: BSD-3-Clause
#include "model/speed_jumps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "model/element_at_rest.hpp"

namespace engrane {

namespace {

/// A speed and its rate, which tells how much of a change is no jump.
struct Speed {
  double v, a;
};

bool jumps(const Speed& before, const Speed& after, double way) {
  constexpr double rounding = 1e-12;
  return std::abs(after.v - before.v) >
         100 * (std::abs(before.a) + std::abs(after.a)) * way + rounding * std::max(std::abs(before.v), std::abs(after.v));
}

/// The rates of the constraints of an element whose nodes are at rest: what its drives impose, with the opposite sign.
class Rates {
 public:
  Rates(const Model& model, const Model::Part& part)
      : part_(part), body_(model, part), phi_(body_.multipliers.size()), rate_(phi_.size()), second_(phi_.size()) {}
  std::vector<Speed> at(double time) {
    State state = body_.view();
    state.time = time;
    part_.element->constraint_rates(state, phi_, rate_, second_);
    std::vector<Speed> all;
    for (std::size_t m = 0; m < rate_.size(); ++m) all.push_back({-rate_[m], -second_[m]});
    return all;
  }

 private:
  const Model::Part& part_;
  ElementAtRest body_;
  std::vector<double> phi_, rate_, second_;
};

}  // namespace

std::optional<SpeedJump> speed_jump(const Model& model, double time) {
  const double just_before = std::nextafter(time, -std::numeric_limits<double>::infinity()), way = time - just_before;
  for (const Model::Part& part : model.parts) {
    const auto& multipliers = part.element->layout().multipliers;
    if (std::none_of(multipliers.begin(), multipliers.end(), [](const Multiplier& m) { return m.role == Role::drive; })) continue;
    Rates rates(model, part);
    const std::vector<Speed> before = rates.at(just_before), after = rates.at(time);
    for (std::size_t m = 0; m < multipliers.size(); ++m)
      if (multipliers[m].role == Role::drive && jumps(before[m], after[m], way))
        return SpeedJump{&part, 0, 0, after[m].v - before[m].v,
                         multipliers[m].dimension.length != 0 ? dimension::velocity : dimension::angular_velocity};
  }
  for (const Support& s : model.supports) {
    if (!s.function) continue;
    const Function::Jet f = s.function->at(just_before), g = s.function->at(time);
    if (jumps({s.value * f.d1, s.value * f.d2}, {s.value * g.d1, s.value * g.d2}, way))
      return SpeedJump{nullptr, s.node, s.component, s.value * (g.d1 - f.d1),
                       s.component < 3 ? dimension::velocity : dimension::angular_velocity};
  }
  return {};
}

}  // namespace engrane
