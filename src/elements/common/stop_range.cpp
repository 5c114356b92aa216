// SPDX-License-Identifier: BSD-3-Clause
#include "elements/common/stop_range.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace engrane::elements {

bool set_stop_damping(const deck::Tagged& damping, const BuildContext& context, const std::string& keyword, StopLaw& law) {
  if (!damping.given()) return true;
  const std::vector<double>& v = damping.values;
  if (std::any_of(v.begin(), v.end(), [](double x) { return x < 0; })) {
    context.error(keyword, "damping must not be negative");
    return false;
  }
  if (damping.is("REST")) {
    if (!(v[0] > 0 && v[0] <= 1) || !(v[1] > 0)) {
      context.error(keyword,
                    fmt::format("REST {} {}: no coefficient of restitution at a speed of impact", number(v[0]), number(v[1])),
                    "REST e v with 0 < e <= 1 and v > 0: what arrives with v leaves with e v");
      return false;
    }
    law.hunt = StopLaw::hunt_of_restitution(v[0], v[1]);
  } else if (damping.is("HUNT")) {
    law.hunt = v[0];
  } else {
    law.linear = v[0];
  }
  return true;
}

double StopRange::gap(double value) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (const StopLimit& limit : limits) nearest = std::min(nearest, -limit.pressed(value));
  return nearest;
}

double StopRange::stored(double value) const {
  double sum = 0;
  for (const StopLimit& limit : limits) sum += law.stored(limit.pressed(value));
  return sum;
}

double StopRange::lost(double value, double rate) const {
  double sum = 0;
  for (const StopLimit& limit : limits) {
    const double pressed = limit.pressed(value), growth = -limit.sign * rate;
    if (pressed > 0) sum += (law.force(pressed, growth, 0) - law.elastic(pressed)) * growth;
  }
  return sum;
}

void StopRange::name_switches(std::vector<SwitchNames>& names, const std::string& before) const {
  for (const StopLimit& limit : limits) {
    const std::string stop = before + (limit.sign > 0 ? "lower stop" : "upper stop");
    names.push_back({stop + " touches", stop + " parts"});
    if (law.damped()) names.push_back({stop + " presses again", stop + " presses no more"});
  }
}

std::size_t StopRange::switches(double value, double rate, double second, std::span<Switch> values) const {
  std::size_t next = 0;
  for (const StopLimit& limit : limits) {
    const double pressed = limit.pressed(value), speed = -limit.sign * rate, growth = -limit.sign * second;
    values[next++] = {pressed, speed, std::abs(limit.place) + std::abs(value) + std::numeric_limits<double>::min()};
    if (!law.damped()) continue;
    values[next++] = pressed > 0 ? Switch{law.pressure(pressed, speed), law.pressure_rate(pressed, speed, growth),
                                          law.pressure_size(pressed, speed)}
                                 : Switch{};
  }
  return next;
}

std::optional<StopRange> StopRange::of(const BuildContext& context, const StopRangeData& data, const StopWords& words,
                                       double unit) {
  StopRange range;
  range.law.stiffness = data.stiffness;
  range.law.exponent = data.exponent;
  if (!set_stop_damping(data.damping, context, words.damping, range.law)) return {};
  if (data.lower && data.upper && *data.lower > *data.upper) {
    context.error(words.upper,
                  fmt::format("{} {} is below {} {}", words.upper, number(*data.upper), words.lower, number(*data.lower)));
    return {};
  }
  if (data.lower) range.limits.push_back({unit * *data.lower, 1});
  if (data.upper) range.limits.push_back({unit * *data.upper, -1});
  // the nearer limit: "no lower limit" is often written as MIN -1E9
  double nearest = std::numeric_limits<double>::infinity();
  for (const StopLimit& limit : range.limits)
    if (limit.place != 0) nearest = std::min(nearest, std::abs(limit.place));
  if (std::isfinite(nearest)) range.law.reach = nearest;
  return range;
}

void add_stop_damping(deck::FieldBuilder field) {
  field.option({"HUNT", {}, "Hunt and Crossley: the force is multiplied by 1 + d times the rate of penetration", 1, 1})
      .option({"REST", {"RESTITUTION"}, "Hunt and Crossley with the d for which what arrives with v leaves with e v: e v", 2, 2})
      .option({"LINEAR", {"LINEAIRE"}, "a damper beside the spring: c", 1, 1});
}

}  // namespace engrane::elements
