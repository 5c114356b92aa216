// SPDX-License-Identifier: BSD-3-Clause
#include "solve/schemes/step_error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "solve/constraints/constraint_factors.hpp"

namespace engrane::solve {

namespace {

/// Least motion in the whole run by which errors are judged, as a fraction of the model or of a radian.
constexpr double least_motion = 1e-3;
/// Least range of velocities by which errors are judged, as a fraction of the fastest of its kind.
constexpr double negligible = 1e-3;
/// Fraction of its tolerance that a step may leave open for the next.
constexpr double share_left_open = 0.1;
constexpr double rounding = 64 * std::numeric_limits<double>::epsilon();

}  // namespace

StepError::StepError(const Model& model, const Numbering& numbering, const SolverOptions& options)
    : tolerance_(options.tolerance) {
  if (!wanted()) return;
  const double span = options.analysis == SolverOptions::Analysis::statics ? 1 : options.end - options.begin;
  const auto slots = static_cast<std::size_t>(numbering.motion_slots()), nodal = 6 * model.nodes.size();
  for (const Unknown& u : numbering.unknowns()) {
    if (u.multiplier) continue;
    const auto slot = static_cast<std::size_t>(u.slot);
    const std::size_t first = slot < nodal ? slot - slot % 3 : slot;
    if (groups_.empty() || groups_.back().first != first)
      groups_.push_back({first, slot < nodal ? std::size_t{3} : std::size_t{1},
                         u.signal ? signals : static_cast<std::size_t>(u.measure), size_of(u, model.extent()),
                         least_motion * size_of(u, model.extent()) / span});
    groups_.back().free[slot - first] = true;
  }
  least_.assign(slots, std::numeric_limits<double>::infinity());
  largest_.assign(slots, -std::numeric_limits<double>::infinity());
}

void StepError::take(std::span<const double> velocities) {
  for (std::size_t i = 0; i < velocities.size(); ++i) {
    least_[i] = std::min(least_[i], velocities[i]);
    largest_[i] = std::max(largest_[i], velocities[i]);
  }
}

double StepError::range(const Group& group, std::span<const double> velocities) const {
  double square = 0;
  for (std::size_t i = group.first; i < group.first + group.size; ++i) {
    const double part = std::max(largest_[i], velocities[i]) - std::min(least_[i], velocities[i]);
    square += part * part;
  }
  return std::sqrt(square);
}

std::vector<double> StepError::allowed(std::span<const double> velocities) const {
  std::array<double, kinds> fastest{};
  std::vector<double> scales(groups_.size());
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    scales[g] = range(groups_[g], velocities);
    fastest[groups_[g].kind] = std::max(fastest[groups_[g].kind], scales[g]);
  }
  for (std::size_t g = 0; g < groups_.size(); ++g)
    scales[g] = tolerance_ * std::max({scales[g], groups_[g].least, negligible * fastest[groups_[g].kind]});
  return scales;
}

double StepError::over_tolerance(std::span<const double> rates, std::span<const double> velocities, double h, double open) const {
  const std::vector<double> scales = allowed(velocities);
  double largest = 0;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const Group& group = groups_[g];
    for (std::size_t k = 0; k < group.size; ++k) {
      const std::size_t slot = group.first + k;
      if (group.free[k])
        largest = std::max(largest,
                           (std::abs(rates[slot]) - rounding * std::abs(velocities[slot]) - open * group.place / h) / scales[g]);
    }
  }
  return largest;
}

double StepError::may_be_open(std::span<const double> velocities, double h) const {
  const std::vector<double> scales = allowed(velocities);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t g = 0; g < groups_.size(); ++g) least = std::min(least, scales[g] * h / groups_[g].place);
  return std::max(share_left_open * least, known);
}

void StepError::save(Snapshot& snapshot) const {
  if (!wanted()) return;
  snapshot.put("scheme/slowest_velocities", least_);
  snapshot.put("scheme/fastest_velocities", largest_);
}

void StepError::load(const Snapshot& snapshot) {
  if (!wanted() || !snapshot.has("scheme/slowest_velocities")) return;
  least_ = snapshot.array("scheme/slowest_velocities");
  largest_ = snapshot.array("scheme/fastest_velocities");
}

}  // namespace engrane::solve
