// SPDX-License-Identifier: BSD-3-Clause
// Velocities, accelerations and multipliers that fit the positions at the end of a step of Radau IIA.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "solve/schemes/radau.hpp"

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

void Radau::renew_balance(const Configuration& c) {
  context_.assembler.projection(c, Assembler::Metric::dynamic, {}, balance_matrix_);
  balance_kept_ = error_.wanted();
  balance_fits_ = true;
}

bool Radau::solve_balance(std::vector<double>& change, std::span<const double>& found) {
  context_.assembler.spread(right_side_, right_);
  if (!balance_.solve(right_, solution_)) {
    balance_kept_ = false;
    return false;
  }
  found = context_.assembler.gather(solution_);
  change.assign(context_.motion.size(), 0.0);
  context_.motion.scatter(found, change);
  return true;
}

bool Radau::leave_admissible(std::vector<double>& rates) {
  // what opens the constraints is that row of the matrix times the rates
  right_side_.assign(static_cast<std::size_t>(context_.numbering.equations()), 0.0);
  context_.motion.gather(rates, right_side_);
  context_.assembler.spread(right_side_, right_);
  check_petsc(MatMult(balance_matrix_, right_, solution_));
  const auto opened = context_.assembler.gather(solution_);
  for (std::size_t e = 0; e < right_side_.size(); ++e)
    right_side_[e] = context_.numbering.unknown(static_cast<int>(e)).multiplier ? opened[e] : 0;
  std::vector<double> inadmissible;
  std::span<const double> found;
  if (!solve_balance(inadmissible, found)) return false;
  std::transform(rates.begin(), rates.end(), inadmissible.begin(), rates.begin(), std::minus<>());
  return true;
}

std::vector<double> Radau::inertia_of(std::span<const double> accelerations) {
  const StageMatrices* const matrices = kept_.current();
  std::vector<double> forces;
  if (!matrices) return forces;
  forces.assign(context_.motion.size(), 0.0);
  std::copy(accelerations.begin(), accelerations.end(), forces.begin());
  right_side_.assign(static_cast<std::size_t>(context_.numbering.equations()), 0.0);
  context_.motion.gather(forces, right_side_);
  context_.assembler.spread(right_side_, right_);
  check_petsc(MatMult(matrices->mass, right_, solution_));
  context_.motion.scatter(context_.assembler.gather(solution_), forces);
  return forces;
}

bool Radau::worth(std::span<const double> change, std::span<const double> rates) const {
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

double Radau::least_correction() const { return std::max(least_change, share_of_precision * context_.options.precision); }

bool Radau::complete(Configuration& c) {
  if (balance_kept_)
    balance_fits_ = false;
  else
    renew_balance(c);
  return fit_velocities(c) && fit_accelerations(c);
}

bool Radau::fit_velocities(Configuration& c) {
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
  if (!solve_balance(change, found)) return false;
  if (!balance_fits_ && worth(change, v)) {
    renew_balance(c);
    if (!solve_balance(change, found)) return false;
  }
  std::transform(v.begin(), v.end(), change.begin(), v.begin(), std::plus<>());
  context_.motion.set_velocities(v, c);
  return true;
}

bool Radau::fit_accelerations(Configuration& c) {
  const Numbering& numbering = context_.numbering;
  const MasslessMotions* massless = massless_at(c);
  std::vector<double> change;
  std::span<const double> found;
  auto a = context_.motion.accelerations(c);
  // one correction if forces are linear in these
  double before = std::numeric_limits<double>::infinity(), first = 0;
  bool settled = false;
  for (int k = 0; k < most_corrections; ++k) {
    if (settled && !context_.redundancy.share(c)) break;
    settled = false;
    right_side_ = context_.start.out_of_balance(c, massless);
    const double size = largest(right_side_);
    if (!std::isfinite(size)) return false;
    if (k == 0) first = size;
    const bool balanced = size <= left_open * first;
    if (!balanced && !balance_fits_ && size > slow_balance * before) {
      renew_balance(c);
    } else if (balanced || (k > 0 && size >= 0.5 * before)) {
      if (!context_.redundancy.share(c)) {
        // reports friction that jams
        if (!balanced && has_friction_) context_.start.balance_accelerations(c, most_corrections, nullptr, massless);
        break;
      }
      before = std::numeric_limits<double>::infinity();
      continue;
    }
    before = size;
    if (!solve_balance(change, found)) return false;
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
    settled = error_.wanted() && changed <= least_correction() * most && !worth(change, a);
  }
  return true;
}

void Radau::drift(Configuration& c, double h) {
  if (!error_.wanted()) return Dynamics::drift(c, h);
  // Heun's step as there, and what fits after it, with the matrix that steps keep
  const auto before = context_.motion.accelerations(c);
  Configuration later = glide(c, h);
  auto a = context_.motion.accelerations(later);
  context_.motion.prescribe_accelerations(later.time, a);
  context_.motion.set_accelerations(a, later);
  if (balance_kept_)
    balance_fits_ = false;
  else
    renew_balance(later);
  if (!fit_accelerations(later)) return Dynamics::drift(c, h);
  auto v = context_.motion.velocities(later);
  const auto after = context_.motion.accelerations(later);
  for (std::size_t i = 0; i < v.size(); ++i) v[i] += 0.5 * h * (after[i] - before[i]);
  context_.motion.prescribe_rates(later.time, v);
  context_.motion.set_velocities(v, later);
  if (constrained() && !(fit_velocities(later) && fit_accelerations(later))) return Dynamics::drift(c, h);
  c = std::move(later);
  forget_motion();
}

}  // namespace engrane::solve
