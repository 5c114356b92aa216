// SPDX-License-Identifier: BSD-3-Clause
#include "solve/schemes/end_projection.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "solve/schemes/snapshot_part.hpp"

namespace engrane::solve {

namespace {

/// Fraction of the first imbalance at which forces count as balanced.
constexpr double left_open = 1e-8;
/// A matrix of an earlier configuration that leaves more than this after one correction is made anew: left_open would take
/// eight corrections, which cost about as much.
constexpr double slow_balance = 0.1;
constexpr int most_corrections = 12;
/// A correction below this fraction of the precision of steps is not followed by another.
constexpr double share_of_precision = 1e-3;
constexpr double least_change = 64 * std::numeric_limits<double>::epsilon();

}  // namespace

EndProjection::EndProjection(SolverContext& context, bool keeps)
    : context_(context),
      keeps_(keeps),
      matrix_(),
      solver_((*matrix_.out() = context.assembler.new_matrix(), matrix_), context.solver.package(),
              kinds_of_rows(context.numbering)) {
  for (const Model::Part& part : context.model.parts) has_friction_ = has_friction_ || part.element->layout().has_friction();
  *right_.out() = context.assembler.new_vector();
  *solution_.out() = context.assembler.new_vector();
}

void EndProjection::begin(const Configuration& c) {
  if (kept_)
    fits_ = false;
  else
    renew(c);
}

void EndProjection::renew(const Configuration& c) {
  context_.assembler.projection(c, Assembler::Metric::dynamic, {}, matrix_);
  kept_ = keeps_;
  fits_ = true;
}

bool EndProjection::fit_velocities(Configuration& c) {
  Assembler& assembler = context_.assembler;
  const Numbering& numbering = context_.numbering;
  std::vector<double> phi, rate, second, change;
  std::span<const double> found;
  auto v = context_.motion.velocities(c);
  assembler.constraint_rates(c, phi, rate, second);
  right_side_.assign(static_cast<std::size_t>(numbering.equations()), 0.0);
  for (std::size_t e = 0; e < right_side_.size(); ++e) {
    const Unknown& u = numbering.unknown(static_cast<int>(e));
    const int m = u.slot - numbering.motion_slots();
    if (u.multiplier && !assembler.released(m)) right_side_[e] = rate[static_cast<std::size_t>(m)];
  }
  // what stages leave of the rates lies along the forces of the multipliers here, not where the matrix was evaluated
  if (!solve(change, found)) return false;
  if (!fits_ && worth(change, v)) {
    renew(c);
    if (!solve(change, found)) return false;
  }
  std::transform(v.begin(), v.end(), change.begin(), v.begin(), std::plus<>());
  context_.motion.set_velocities(v, c);
  return true;
}

bool EndProjection::fit_accelerations(Configuration& c, const MasslessMotions* massless) {
  const Numbering& numbering = context_.numbering;
  std::vector<double> change;
  std::span<const double> found;
  auto a = context_.motion.accelerations(c);
  // one correction if forces are linear in these
  double before = std::numeric_limits<double>::infinity(), first = 0;
  bool settled = false, begun = false;
  const auto shares = [&](int corrections) {
    constexpr int needed = 3;
    if (!context_.redundancy.share(c, corrections + needed > most_corrections)) return false;
    // the forces that the matrix holds are those of the multipliers before
    before = std::numeric_limits<double>::infinity();
    fits_ = begun = false;
    return true;
  };
  for (int k = 0; k < most_corrections; ++k) {
    if (settled && !shares(k)) break;
    settled = false;
    right_side_ = context_.start.out_of_balance(c, massless);
    const double size = largest(right_side_);
    if (!std::isfinite(size)) return false;
    if (!std::exchange(begun, true)) first = size;
    const bool balanced = size <= left_open * first;
    if (!balanced && !fits_ && size > slow_balance * before) {
      renew(c);
    } else if (balanced || (k > 0 && size >= 0.5 * before)) {
      if (!shares(k)) {
        // reports friction that jams
        if (!balanced && has_friction_) context_.start.balance_accelerations(c, most_corrections, nullptr, massless);
        break;
      }
      continue;
    }
    before = size;
    if (!solve(change, found)) return false;
    if (massless) massless->remove(change);
    std::transform(a.begin(), a.end(), change.begin(), a.begin(), std::plus<>());
    context_.motion.set_accelerations(a, c);
    double most = 0, changed = 0;
    for (std::size_t e = 0; e < found.size(); ++e) {
      const Unknown& u = numbering.unknown(static_cast<int>(e));
      if (!u.multiplier) continue;
      double& multiplier = c.multipliers[static_cast<std::size_t>(u.slot) - context_.motion.size()];
      multiplier += found[e];
      most = std::max(most, std::abs(multiplier));
      changed = std::max(changed, std::abs(found[e]));
    }
    settled = keeps_ && changed <= least_correction() * most && !worth(change, a);
  }
  return true;
}

bool EndProjection::leave_admissible(std::vector<double>& rates) {
  // what opens the constraints is that row of the matrix times the rates
  right_side_.assign(static_cast<std::size_t>(context_.numbering.equations()), 0.0);
  context_.motion.gather(rates, right_side_);
  context_.assembler.spread(right_side_, right_);
  check_petsc(MatMult(matrix_, right_, solution_));
  const auto opened = context_.assembler.gather(solution_);
  for (std::size_t e = 0; e < right_side_.size(); ++e)
    right_side_[e] = context_.numbering.unknown(static_cast<int>(e)).multiplier ? opened[e] : 0;
  std::vector<double> inadmissible;
  std::span<const double> found;
  if (!solve(inadmissible, found)) return false;
  std::transform(rates.begin(), rates.end(), inadmissible.begin(), rates.begin(), std::minus<>());
  return true;
}

bool EndProjection::worth(std::span<const double> change, std::span<const double> rates) const {
  const double extent = context_.model.extent();
  double changed = 0, most = 0;
  for (const Unknown& u : context_.numbering.unknowns()) {
    if (u.multiplier) continue;
    const auto slot = static_cast<std::size_t>(u.slot);
    changed = std::max(changed, std::abs(change[slot]) / size_of(u, extent));
    most = std::max(most, std::abs(rates[slot]) / size_of(u, extent));
  }
  return changed > least_correction() * most;
}

double EndProjection::least_correction() const { return std::max(least_change, share_of_precision * context_.options.precision); }

bool EndProjection::solve(std::vector<double>& change, std::span<const double>& found) {
  context_.assembler.spread(right_side_, right_);
  if (!solver_.solve(right_, solution_)) {
    kept_ = false;
    return false;
  }
  found = context_.assembler.gather(solution_);
  change.assign(context_.motion.size(), 0.0);
  context_.motion.scatter(found, change);
  return true;
}

void EndProjection::save(Snapshot& snapshot) const {
  solver_.save(snapshot);
  if (!kept_) return;
  Snapshot factors;
  solver_.save_factors(factors);
  save_part(factors, "balance/", snapshot);
}

void EndProjection::load(const Snapshot& snapshot) {
  solver_.load(snapshot);
  kept_ = solver_.load_factors(part_of(snapshot, "balance/"));
}

}  // namespace engrane::solve
