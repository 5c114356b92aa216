// SPDX-License-Identifier: BSD-3-Clause
#include "solve/run/step_control.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace engrane::solve {

namespace {

/// Fraction of the step that would just pass, so that most steps do.
constexpr double safety = 0.9;
constexpr double most_growth = 2, most_cut = 0.2;
/// Steps that would grow by less are kept.
constexpr double worthwhile = 1.2;
/// Least error assumed, as a fraction of what the step before predicts.
constexpr double fading = 0.8;
/// Errors below this fraction of the tolerance count as none.
constexpr double least_error = 1e-6;
/// An error is that of a jump if it is the same, but for this factor, for steps of which one is so many times as long as another.
/// Where a path has a corner it falls with the step, and near a limit load with its square root, to a tenth.
constexpr double same_error = 2, many_times = 100;
/// Largest number of combinations of sides for which steps after events are kept.
constexpr std::size_t most_sides = 1000;

}  // namespace

StepControl::StepControl(const SolverOptions& options, int order)
    : active_(options.tolerance > 0), longest_(options.longest), order_(order) {}

double StepControl::after(double size, double error, double asked, Landing landing) {
  const double step = next(size, error, asked);
  if (!entered_.empty() && steps_.size() < most_sides) remember(size, step, landing);
  entered_.clear();
  return step;
}

void StepControl::remember(double size, double step, Landing landing) {
  // a step that ended where the event was predicted says nothing for or against longer ones
  const auto [known, first] = steps_.try_emplace(entered_, landing == Landing::none ? step : worthwhile * size);
  if (first || landing == Landing::foreseen) return;
  known->second = std::min(worthwhile * (landing == Landing::none ? known->second : size), step);
}

double StepControl::enter(const std::vector<int>& sides, double asked) {
  entered_ = sides;
  const auto known = steps_.find(sides);
  return known == steps_.end() ? asked : std::min(known->second, longest_);
}

double StepControl::next(double size, double error, double asked) {
  error = std::max(error, least_error);
  // where the estimate passes through zero the error does not
  if (size_before_ > 0) error = std::max(error, fading * error_before_ * std::pow(size / size_before_, order_));
  // what the error itself asks for, and what its change since the step before predicts (Hairer and Wanner, Solving Ordinary
  // Differential Equations II, 1996, IV.8.25)
  double factor = safety * std::pow(error, -1 / order_);
  if (size_before_ > 0)
    factor = std::min(factor, safety * size / size_before_ * std::pow(error_before_ / (error * error), 1 / order_));
  error_before_ = error;
  size_before_ = size;
  const bool grow = !std::exchange(refused_, false);
  const double found = size * std::clamp(factor, most_cut, grow ? most_growth : 1.0);
  // a step cut short says little about those that are not
  if (size < asked && error <= 1) return std::min(std::max(found, asked), longest_);
  const bool stay = factor < worthwhile && error <= safety;
  return std::min(stay ? std::max(size, asked) : found, longest_);
}

double StepControl::retry(double size, double error) {
  refused_ = true;
  const double factor = std::clamp(safety * std::pow(error, -1 / order_), most_cut, safety);
  // the next steps do not return to this length at once; but where the error is large at any length, as near a singular
  // position, only a longer step gets past
  if (factor > most_cut) {
    error_before_ = std::pow(safety / factor, order_);
    size_before_ = size;
  }
  return size * factor;
}

bool StepControl::stays(double begin, double size, double error) {
  std::erase_if(inaccurate_, [begin](const Attempt& a) { return a.end <= begin; });
  inaccurate_.push_back({begin + size, size, error});
  // from the shortest on; attempts much longer than needed may have had other errors beside
  for (auto a = inaccurate_.rbegin(); a != inaccurate_.rend(); ++a) {
    if (!(a->error <= same_error * error && error <= same_error * a->error)) return false;
    if (a->size >= many_times * size) return true;
  }
  return false;
}

void StepControl::begin_anew() {
  error_before_ = 1;
  size_before_ = 0;
  refused_ = false;
  inaccurate_.clear();
}

void StepControl::save(Snapshot& snapshot) const {
  snapshot.put("runner/error", {error_before_, size_before_, refused_ ? 1.0 : 0.0});
  std::vector<double> inaccurate;
  for (const Attempt& a : inaccurate_) inaccurate.insert(inaccurate.end(), {a.end, a.size, a.error});
  snapshot.put("runner/inaccurate_attempts", std::move(inaccurate));
  std::vector<double> steps;
  for (const auto& [sides, step] : steps_) {
    steps.insert(steps.end(), sides.begin(), sides.end());
    steps.push_back(step);
  }
  snapshot.put("runner/steps_behind_events", std::move(steps));
  snapshot.put("runner/entered", {entered_.begin(), entered_.end()});
}

void StepControl::load(const Snapshot& snapshot, std::size_t sides) {
  if (!snapshot.has("runner/error")) return;
  error_before_ = snapshot.array("runner/error").at(0);
  size_before_ = snapshot.array("runner/error").at(1);
  refused_ = snapshot.array("runner/error").at(2) != 0;
  inaccurate_.clear();
  if (snapshot.has("runner/inaccurate_attempts")) {
    const std::vector<double>& all = snapshot.array("runner/inaccurate_attempts");
    for (std::size_t i = 0; i + 2 < all.size(); i += 3) inaccurate_.push_back({all[i], all[i + 1], all[i + 2]});
  }
  if (!snapshot.has("runner/entered")) return;
  const auto whole = [](double side) { return static_cast<int>(side); };
  const std::vector<double>&entered = snapshot.array("runner/entered"), &steps = snapshot.array("runner/steps_behind_events");
  entered_.resize(entered.size());
  std::transform(entered.begin(), entered.end(), entered_.begin(), whole);
  steps_.clear();
  for (std::size_t i = 0; i + sides < steps.size(); i += sides + 1) {
    std::vector<int> key(sides);
    std::transform(&steps[i], &steps[i] + sides, key.begin(), whole);
    steps_[std::move(key)] = steps[i + sides];
  }
}

}  // namespace engrane::solve
