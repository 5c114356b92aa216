// SPDX-License-Identifier: BSD-3-Clause
#include "model/speed_jumps.hpp"

#include <algorithm>
#include <vector>

#include "model/element_at_rest.hpp"
#include "model/jump.hpp"

namespace engrane {

namespace {

/// The rates of the constraints of an element whose nodes are at rest: what its drives impose, with the opposite sign.
class Rates {
 public:
  Rates(const Model& model, const Model::Part& part)
      : part_(part), body_(model, part), phi_(body_.multipliers.size()), rate_(phi_.size()), second_(phi_.size()) {}
  std::vector<ValueAndRate> at(double time) {
    State state = body_.view();
    state.time = time;
    part_.element->constraint_rates(state, phi_, rate_, second_);
    std::vector<ValueAndRate> all;
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
  const double just_before = number_before(time), way = time - just_before;
  for (const Model::Part& part : model.parts) {
    const auto& multipliers = part.element->layout().multipliers;
    if (std::none_of(multipliers.begin(), multipliers.end(), [](const Multiplier& m) { return m.role == Role::drive; })) continue;
    Rates rates(model, part);
    const std::vector<ValueAndRate> before = rates.at(just_before), after = rates.at(time);
    for (std::size_t m = 0; m < multipliers.size(); ++m)
      if (multipliers[m].role == Role::drive && jumps(before[m], after[m], way))
        return SpeedJump{&part, 0, after[m].value - before[m].value,
                         multipliers[m].dimension.length != 0 ? dimension::velocity : dimension::angular_velocity};
  }
  for (const Support& s : model.supports) {
    if (!s.function) continue;
    const Function::Jet f = s.function->at(just_before), g = s.function->at(time);
    if (jumps({s.value * f.d1, s.value * f.d2}, {s.value * g.d1, s.value * g.d2}, way))
      return SpeedJump{nullptr, s.node, s.value * (g.d1 - f.d1),
                       s.component < 3 ? dimension::velocity : dimension::angular_velocity};
  }
  return {};
}

}  // namespace engrane
