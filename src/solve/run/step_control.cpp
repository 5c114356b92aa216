// SPDX-License-Identifier: BSD-3-Clause
#include "solve/run/step_control.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace engrane::solve {

namespace {

/// Part of the step that would just pass, so that most do.
constexpr double safety = 0.9;
/// Shares of the last error and of the one before in the exponent.
constexpr double proportional = 0.7, integral = 0.4;
constexpr double most_growth = 2, most_cut = 0.2;
/// Steps that would grow by less stay.
constexpr double worthwhile = 1.2;
/// Errors below this are nothing.
constexpr double least_error = 1e-10;

}  // namespace

StepControl::StepControl(const SolverOptions& options, int order)
    : active_(options.tolerance > 0), longest_(options.longest), order_(order) {}

double StepControl::after(double size, double error, double asked) {
  error = std::max(error, least_error);
  const double factor = safety * std::pow(error, -proportional / order_) * std::pow(before_, integral / order_);
  before_ = error;
  const bool grow = !std::exchange(refused_, false);
  const double next = size * std::clamp(factor, most_cut, grow ? most_growth : 1.0);
  // a step cut short tells little of those that are not
  if (size < asked && error <= 1) return std::min(std::max(next, asked), longest_);
  const bool stay = factor < worthwhile && error <= safety;
  return std::min(stay ? std::max(size, asked) : next, longest_);
}

double StepControl::retry(double size, double error) {
  refused_ = true;
  return size * std::clamp(safety * std::pow(error, -1 / order_), most_cut, safety);
}

void StepControl::save(Snapshot& snapshot) const {
  snapshot.put("runner/error", {before_, refused_ ? 1.0 : 0.0});
}

void StepControl::load(const Snapshot& snapshot) {
  if (!snapshot.has("runner/error")) return;
  before_ = snapshot.array("runner/error").at(0);
  refused_ = snapshot.array("runner/error").at(1) != 0;
}

}  // namespace engrane::solve
