// SPDX-License-Identifier: BSD-3-Clause
#include "solve/schemes/step_error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "model/fine_forces.hpp"
#include "solve/constraints/constraint_factors.hpp"

namespace engrane::solve {

namespace {

/// Least motion in the whole run by which errors are judged, as a fraction of the model or of a radian.
constexpr double least_motion = 1e-3;
/// Least range of velocities by which errors are judged, as a fraction of the fastest of its kind.
constexpr double negligible = 1e-3;
/// Least change of a signal in the whole run by which its errors are judged, as a fraction of what it would be if what it
/// measures moved by the extent of the model: far above its rounding, and far below what any controller is for.
constexpr double least_signal = 1e-9;
/// Fraction of its tolerance that a step may leave open for the next.
constexpr double share_left_open = 0.1;
/// Largest angle of a node in a step over the fourth root of TOL. What goes round with it lies on polynomials between the
/// instants where it is known: two ends and two instants inside a step of Radau, and only ends with other schemes. Of half its
/// range it is off by 1e-4 and 5e-3 times the sixth power of the angle.
constexpr double turn_of_radau = 16, turn_between_ends = 8;
/// Largest angle of FineForces in a step.
constexpr double longest_repetition = std::numbers::pi;
constexpr double rounding = 64 * std::numeric_limits<double>::epsilon();

}  // namespace

StepError::StepError(const Assembler& assembler, const SolverOptions& options)
    : tolerance_(options.tolerance),
      longest_turn_((options.family == SolverOptions::Family::radau ? turn_of_radau : turn_between_ends) *
                    std::pow(tolerance_, 0.25)),
      nodes_(assembler.model().nodes.size()),
      statics_(options.analysis == SolverOptions::Analysis::statics) {
  if (!wanted()) return;
  const Model& model = assembler.model();
  const Numbering& numbering = assembler.numbering();
  const double span = statics_ ? 1 : options.end - options.begin;
  const auto slots = static_cast<std::size_t>(numbering.motion_slots()), nodal = 6 * model.nodes.size();
  for (std::size_t p = 0; p < model.parts.size(); ++p) {
    const auto* fine = dynamic_cast<const FineForces*>(model.parts[p].element.get());
    const std::optional<FineForces::Repetition> repetition = fine ? fine->repetition() : std::nullopt;
    if (!repetition) continue;
    const auto scalar = static_cast<std::size_t>(model.parts[p].element->layout().node_slots() + repetition->scalar);
    const int slot = numbering.part_slots(static_cast<int>(p))[scalar];
    repeating_.push_back({static_cast<std::size_t>(slot), repetition->factor});
  }
  std::optional<Configuration> begin;
  for (const Unknown& u : numbering.unknowns()) {
    if (u.multiplier) continue;
    const auto slot = static_cast<std::size_t>(u.slot);
    const std::size_t first = slot < nodal ? slot - slot % 3 : slot;
    if (groups_.empty() || groups_.back().first != first) {
      const double size = size_of(u, model.extent());
      groups_.push_back({first, slot < nodal ? std::size_t{3} : std::size_t{1}, static_cast<std::size_t>(u.measure), size,
                         least_motion * size / span});
      if (u.signal) {
        if (!begin) begin = numbering.reference_configuration(options.begin);
        const Signal signal = signal_of(assembler, *begin, u);
        // a slow change over the span is one of x/κ, by a rate that is smaller by the lag over the span
        const double share = statics_ ? 1 : signal.lag / (signal.lag + span);
        groups_.back().least = share * (least_motion * signal.begin + least_signal * (signal.level + signal.by_speed / span)) +
                               std::numeric_limits<double>::min();
        groups_.back().signal = signal;
      }
    }
    groups_.back().free[slot - first] = true;
  }
  least_.assign(slots, std::numeric_limits<double>::infinity());
  largest_.assign(slots, -std::numeric_limits<double>::infinity());
}

StepError::Signal StepError::signal_of(const Assembler& assembler, const Configuration& c, const Unknown& u) const {
  const Element& element = *assembler.model().parts[static_cast<std::size_t>(u.part)].element;
  const Layout& layout = element.layout();
  const State state = assembler.view(u.part, c);
  const auto slots = static_cast<std::size_t>(layout.slots()), scalars = static_cast<std::size_t>(layout.node_slots());
  const double extent = assembler.model().extent();
  std::vector<double> r(slots), k(slots * slots);
  // what reaches one state of a law goes on to the others
  const auto largest = [&](const Weights& weights) {
    element.tangent(state, weights, r, k);
    double most = 0;
    for (std::size_t node = 0; node < layout.nodes.size(); ++node)
      for (const NodeNeed need : {NodeNeed::translation, NodeNeed::in_plane, NodeNeed::rotation}) {
        const int begin = layout.node_slot(node, need), count = need == NodeNeed::in_plane ? 2 : 3;
        for (int column = begin; begin >= 0 && column < begin + count; ++column)
          for (std::size_t row = scalars; row < scalars + layout.scalars.size(); ++row) {
            const double by = std::abs(k[row * slots + static_cast<std::size_t>(column)]);
            if (std::isfinite(by)) most = std::max(most, by * (need == NodeNeed::rotation ? 1 : extent));
          }
      }
    return most;
  };
  Signal signal;
  signal.level = largest({1, 0, 0});
  if (!statics_) signal.by_speed = largest({0, 1, 0});
  element.tangent(state, {0, 0, 1}, r, k);
  const std::size_t own = scalars + static_cast<std::size_t>(u.item);
  signal.lag = std::abs(k[own * slots + own]);
  signal.begin = std::abs(state.scalars[static_cast<std::size_t>(u.item)]) / signal.lag;
  if (!statics_) return signal;
  // their displacements x/κ: equations are in the unit of x
  signal.level *= signal.lag;
  signal.begin *= signal.lag;
  signal.lag = 0;
  return signal;
}

double StepError::Signal::noise(double h, double open) const {
  return open * (level + by_speed / h) * h / (h + lag) + rounding * begin;
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
  std::array<double, measures> fastest{};
  std::vector<double> scales(groups_.size());
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    scales[g] = range(groups_[g], velocities);
    double& most = fastest[groups_[g].measure];
    if (!groups_[g].signal) most = std::max(most, scales[g]);
  }
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const Group& group = groups_[g];
    scales[g] = tolerance_ * std::max({scales[g], group.least, group.signal ? 0 : negligible * fastest[group.measure]});
  }
  return scales;
}

double StepError::over_tolerance(std::span<const double> rates, std::span<const double> velocities, double h, double open) const {
  const std::vector<double> scales = allowed(velocities);
  double largest = 0;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const Group& group = groups_[g];
    const double noise = group.noise(h, open);
    for (std::size_t k = 0; k < group.size; ++k) {
      const std::size_t slot = group.first + k;
      if (group.free[k])
        largest = std::max(largest, (std::abs(rates[slot]) - rounding * std::abs(velocities[slot]) - noise) / scales[g]);
    }
  }
  return largest;
}

double StepError::over_turn(std::span<const double> velocities, double h, int order) const {
  double fastest = 0;
  for (std::size_t n = 0; n < nodes_; ++n)
    fastest = std::max(fastest, Eigen::Map<const Vec3>(&velocities[6 * n + 3]).norm() / longest_turn_);
  for (const Repeating& one : repeating_)
    fastest = std::max(fastest, std::abs(one.factor * velocities[one.slot]) / longest_repetition);
  return std::pow(fastest * h, order);
}

double StepError::may_be_open(std::span<const double> velocities, double h) const {
  const std::vector<double> scales = allowed(velocities);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t g = 0; g < groups_.size(); ++g)
    if (!groups_[g].signal) least = std::min(least, scales[g] * h / groups_[g].place);
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
