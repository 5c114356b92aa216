// SPDX-License-Identifier: BSD-3-Clause
#include "model/speed_jumps.hpp"

#include <algorithm>
#include <cmath>
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

/// A speed that a drive or a support imposes, at the number before an instant and at the instant.
struct Imposed {
  const Model::Part* drive = nullptr;
  int node = 0;
  Dimension dimension;
  ValueAndRate before, after;
};

/// Calls `visit` with all of them, until it returns true.
template <class Visit>
void find_imposed(const Model& model, double time, const Visit& visit) {
  const double just_before = number_before(time);
  for (const Model::Part& part : model.parts) {
    const auto& multipliers = part.element->layout().multipliers;
    if (std::none_of(multipliers.begin(), multipliers.end(), [](const Multiplier& m) { return m.role == Role::drive; })) continue;
    Rates rates(model, part);
    const std::vector<ValueAndRate> before = rates.at(just_before), after = rates.at(time);
    for (std::size_t m = 0; m < multipliers.size(); ++m) {
      const bool slides = multipliers[m].dimension.length != 0;
      if (multipliers[m].role == Role::drive &&
          visit(Imposed{&part, 0, slides ? dimension::velocity : dimension::angular_velocity, before[m], after[m]}))
        return;
    }
  }
  for (const Support& s : model.supports) {
    if (!s.function) continue;
    const Function::Jet f = s.function->at(just_before), g = s.function->at(time);
    if (visit(Imposed{nullptr,
                      s.node,
                      s.component < 3 ? dimension::velocity : dimension::angular_velocity,
                      {s.value * f.d1, s.value * f.d2},
                      {s.value * g.d1, s.value * g.d2}}))
      return;
  }
}

}  // namespace

std::optional<SpeedJump> speed_jump(const Model& model, double time) {
  const double way = time - number_before(time);
  std::optional<SpeedJump> found;
  find_imposed(model, time, [&](const Imposed& speed) {
    if (jumps(speed.before, speed.after, way))
      found = {speed.drive, speed.node, speed.after.value - speed.before.value, speed.dimension};
    return found.has_value();
  });
  return found;
}

bool imposed_acceleration_jumps(const Model& model, double time) {
  constexpr double rounding = 1e-9;
  bool found = false;
  find_imposed(model, time, [&](const Imposed& speed) {
    const double before = speed.before.rate, after = speed.after.rate;
    found = std::abs(after - before) > rounding * std::max(std::abs(after), std::abs(before));
    return found;
  });
  return found;
}

}  // namespace engrane
