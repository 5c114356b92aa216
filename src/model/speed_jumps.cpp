// SPDX-License-Identifier: BSD-3-Clause
#include "model/speed_jumps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
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

/// A speed that a drive or a support imposes at an instant.
struct Imposed {
  const Model::Part* drive = nullptr;
  int node = 0;
  Dimension dimension;
  ValueAndRate speed;
};

/// All of them, always in the same order.
std::vector<Imposed> find_imposed(const Model& model, double time) {
  std::vector<Imposed> all;
  for (const Model::Part& part : model.parts) {
    const auto& multipliers = part.element->layout().multipliers;
    if (std::none_of(multipliers.begin(), multipliers.end(), [](const Multiplier& m) { return m.role == Role::drive; })) continue;
    Rates rates(model, part);
    const std::vector<ValueAndRate> speeds = rates.at(time);
    for (std::size_t m = 0; m < multipliers.size(); ++m) {
      if (multipliers[m].role != Role::drive) continue;
      const bool slides = multipliers[m].dimension.length != 0;
      all.push_back({&part, 0, slides ? dimension::velocity : dimension::angular_velocity, speeds[m]});
    }
  }
  for (const Support& s : model.supports) {
    if (!s.function) continue;
    const Function::Jet f = s.function->at(time);
    const Dimension dimension = s.component < 3 ? dimension::velocity : dimension::angular_velocity;
    all.push_back({nullptr, s.node, dimension, {s.value * f.d1, s.value * f.d2}});
  }
  return all;
}

/// Whether a change of a speed is lost in the rounding of positions within a step. Two formulas of one motion differ by as much.
bool is_rounding(const Model& model, const Dimension& dimension, double change) {
  constexpr double rounding = 64 * std::numeric_limits<double>::epsilon();
  return std::abs(change) * model.commands.stepping.step <= rounding * (dimension.length != 0 ? model.extent() : 1.0);
}

}  // namespace

std::vector<ValueAndRate> imposed_speeds(const Model& model, double time) {
  std::vector<ValueAndRate> speeds;
  for (const Imposed& one : find_imposed(model, time)) speeds.push_back(one.speed);
  return speeds;
}

std::optional<SpeedJump> speed_jump(const Model& model, double time, const std::vector<ValueAndRate>& before) {
  const double way = time - number_before(time);
  const std::vector<Imposed> after = find_imposed(model, time);
  for (std::size_t i = 0; i < after.size(); ++i) {
    const ValueAndRate &was = before.at(i), &is = after[i].speed;
    const double change = is.value - was.value;
    if (jumps(was, is, way) && !is_rounding(model, after[i].dimension, change))
      return SpeedJump{after[i].drive, after[i].node, change, after[i].dimension};
  }
  return {};
}

std::optional<SpeedJump> speed_jump(const Model& model, double time) {
  return speed_jump(model, time, imposed_speeds(model, number_before(time)));
}

bool imposed_acceleration_jumps(const Model& model, double time) {
  constexpr double rounding = 1e-9;
  const std::vector<ValueAndRate> before = imposed_speeds(model, number_before(time)), after = imposed_speeds(model, time);
  for (std::size_t i = 0; i < after.size(); ++i)
    if (const double was = before[i].rate, is = after[i].rate;
        std::abs(is - was) > rounding * std::max(std::abs(is), std::abs(was)))
      return true;
  return false;
}

}  // namespace engrane
