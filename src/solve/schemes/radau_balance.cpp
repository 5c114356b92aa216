// SPDX-License-Identifier: BSD-3-Clause
// Balance beside the stages of Radau IIA: at the end of a step, at instants within it, and after a drift.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "solve/schemes/radau.hpp"

namespace engrane::solve {

namespace {

/// Removes the rows of constraints from a residual.
void ignore_constraints(const Assembler& assembler, Vec residual) {
  PetscInt begin = 0, end = 0;
  check_petsc(VecGetOwnershipRange(residual, &begin, &end));
  PetscScalar* values = nullptr;
  check_petsc(VecGetArray(residual, &values));
  for (PetscInt row = begin; row < end; ++row) {
    const Unknown& u = assembler.numbering().unknown(static_cast<int>(row));
    if (u.multiplier && !assembler.released(u.slot - assembler.numbering().motion_slots())) values[row - begin] = 0;
  }
  check_petsc(VecRestoreArray(residual, &values));
}

/// Corrections that balance an instant within a step: 2 to 4 with matrices of its place, more with earlier ones.
constexpr int most_balance_corrections = 12;

}  // namespace

bool Radau::fit_end(Configuration& c) {
  projection_.begin(c);
  return projection_.fit_velocities(c) && projection_.fit_accelerations(c, massless_at(c));
}

bool Radau::restore_balance(Configuration& c) {
  if (!(matrices_step_ > 0)) return false;
  const Configuration before = c;
  const auto v = context_.motion.velocities(c), a = context_.motion.accelerations(c);
  // Stiff or rigid parts find their positions, the others their accelerations. The change of positions counts as one of
  // accelerations too, by 13/h² times it, which is more than their error: forces are found again with the accelerations of the
  // motion.
  const auto found = [&] {
    c = before;
    if (!multipliers_.empty()) multipliers_.at(c.time, 0, c.multipliers);
    const bool moved = balance_near(c, 1);
    context_.motion.set_velocities(v, c);
    context_.motion.set_accelerations(a, c);
    return moved && fit_along_constraints(c) && balance_near(c, most_balance_corrections);
  };
  if (!factored_ || !found()) {
    // Matrices good enough for the step may not be so here; the next phase must not find those of this place.
    keep(at_start_of_step(before), matrices_step_);
    kept_.drop();
    kept_step_ = 0;
    if (!found()) {
      c = before;
      return false;
    }
  }
  constexpr int most_passes = 4;
  for (int pass = 1; pass <= most_passes && context_.redundancy.share(c, pass == most_passes); ++pass)
    if (!balance_near(c, most_balance_corrections)) {
      c = before;
      return false;
    }
  if (!fine_forces_) return true;
  // Corrections by matrices without the slope of such forces change velocities by more than these are off.
  context_.motion.set_velocities(v, c);
  projection_.begin(c);
  if (projection_.fit_accelerations(c, massless_at(c))) return true;
  c = before;
  return false;
}

bool Radau::fit_along_constraints(Configuration& c) {
  if (!constrained()) return true;
  Assembler& assembler = context_.assembler;
  const Numbering& numbering = context_.numbering;
  std::vector<double> phi, rate, second, right(static_cast<std::size_t>(numbering.equations()), 0.0), y(context_.motion.size());
  assembler.constraint_rates(c, phi, rate, second);
  for (std::size_t e = 0; e < right.size(); ++e) {
    const Unknown& u = numbering.unknown(static_cast<int>(e));
    if (!u.multiplier) continue;
    const int m = u.slot - numbering.motion_slots();
    if (!assembler.released(m)) right[e] = -assembler.scale()[static_cast<std::size_t>(m)] * second[static_cast<std::size_t>(m)];
  }
  // the matrix of balance_near() is that of inertia but for the square of the rate, and beside it stiff parts are rigid
  assembler.spread(right, residuals_[0]);
  if (!solver_.solve_real(residuals_[0], changes_[0])) return false;
  context_.motion.scatter(assembler.gather(changes_[0]), y);
  auto a = context_.motion.accelerations(c);
  for (std::size_t slot = 0; slot < y.size(); ++slot) a[slot] += y[slot];
  context_.motion.set_accelerations(a, c);
  return true;
}

bool Radau::balance_near(Configuration& c, int most) {
  Assembler& assembler = context_.assembler;
  // K + (γ/h) C + (γ/h)² M, with the factors that the step has left
  const double rate = solver_.real_rate() / matrices_step_, precision = context_.options.precision;
  std::vector<double> y(context_.motion.size());
  // With matrices of another place one correction may enlarge the residual, two in a row must halve it.
  double left_before = std::numeric_limits<double>::infinity(), left_two_before = left_before;
  for (int k = 0;; ++k) {
    if (most == 1 && k == 1) return true;
    assembler.residual(c, residuals_[0]);
    const Imbalance found = imbalance(assembler, references_, residuals_[0]);
    const double left = std::max(found.largest(), found.constraint_force);
    if (found.within(precision)) return true;
    if (k == most || !std::isfinite(left) || left > 0.5 * left_two_before) return false;
    // closed constraints: their rounding would count as accelerations
    if (most > 1 && found.constraint_force <= precision) ignore_constraints(assembler, residuals_[0]);
    if (!solver_.solve_real(residuals_[0], changes_[0])) return false;
    left_two_before = std::exchange(left_before, left);
    const auto change = assembler.gather(changes_[0]);
    std::fill(y.begin(), y.end(), 0.0);
    context_.motion.scatter(change, y);
    assembler.add_to_multipliers(change, c.multipliers);
    auto v = context_.motion.velocities(c), a = context_.motion.accelerations(c);
    for (std::size_t slot = 0; slot < y.size(); ++slot) {
      v[slot] += rate * y[slot];
      a[slot] += rate * rate * y[slot];
    }
    const Configuration from = c;
    context_.motion.move(from, y, c);
    c = at_start_of_step(std::move(c));
    context_.motion.set_velocities(v, c);
    context_.motion.set_accelerations(a, c);
  }
}

void Radau::drift(Configuration& c, double h) {
  if (!error_.wanted()) return Dynamics::drift(c, h);
  // Heun's step as there, and what fits after it, with the matrix that steps keep
  const auto before = context_.motion.accelerations(c);
  Configuration later = glide(c, h);
  auto a = context_.motion.accelerations(later);
  context_.motion.prescribe_accelerations(later.time, a);
  context_.motion.set_accelerations(a, later);
  projection_.begin(later);
  const auto fit_accelerations = [&] { return projection_.fit_accelerations(later, massless_at(later)); };
  if (!fit_accelerations()) return Dynamics::drift(c, h);
  auto v = context_.motion.velocities(later);
  const auto after = context_.motion.accelerations(later);
  for (std::size_t i = 0; i < v.size(); ++i) v[i] += 0.5 * h * (after[i] - before[i]);
  context_.motion.prescribe_rates(later.time, v);
  context_.motion.set_velocities(v, later);
  if (constrained() && !(projection_.fit_velocities(later) && fit_accelerations())) return Dynamics::drift(c, h);
  c = std::move(later);
  forget_motion();
  leaves_open(c);
}

std::vector<double> Radau::inertia_of(std::span<const double> accelerations) {
  const StageMatrices* const matrices = kept_.current();
  std::vector<double> forces;
  if (!matrices) return forces;
  forces.assign(context_.motion.size(), 0.0);
  std::copy(accelerations.begin(), accelerations.end(), forces.begin());
  std::vector<double> by_equation(static_cast<std::size_t>(context_.numbering.equations()), 0.0);
  context_.motion.gather(forces, by_equation);
  const Vec factor = changes_[0], product = residuals_[0];  // free between two steps
  context_.assembler.spread(by_equation, factor);
  check_petsc(MatMult(matrices->mass, factor, product));
  context_.motion.scatter(context_.assembler.gather(product), forces);
  return forces;
}

}  // namespace engrane::solve
