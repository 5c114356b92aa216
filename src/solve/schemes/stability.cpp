// SPDX-License-Identifier: BSD-3-Clause
#include "solve/schemes/stability.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solve/algebra/probe.hpp"
#include "solve/algebra/tangent_factors.hpp"
#include "solve/schemes/load_derivative.hpp"

namespace engrane::solve {

namespace {

/// Equilibria examined beside the last.
constexpr int looks = 8;
/// Largest number of equations: the factors of larger ones take a good part of the memory.
constexpr int most_equations = 50000;
/// A direction that resists by less than this fraction has no sign.
constexpr double neutral = 1e-13;

/// Takes the columns of released constraints, whose multipliers do not change, out of the tangent: it is then symmetric.
void leave_out_released(const SolverContext& context, Mat tangent) {
  if (context.assembler.half()) return;
  std::vector<PetscInt> rows;
  for (int row = context.numbering.first_row(); row < context.numbering.end_row(); ++row)
    if (const Unknown& u = context.numbering.unknown(row);
        u.multiplier && context.assembler.released(u.slot - context.numbering.motion_slots()))
      rows.push_back(row);
  check_petsc(MatZeroRowsColumns(tangent, static_cast<PetscInt>(rows.size()), rows.data(), -1, nullptr, nullptr));
}

/// Do loads without a potential, such as a moment about a fixed axis in space, matter in a motion x: is the antisymmetric part of
/// the tangent K, by Σ |x (K − Kᵀ) x|, more than a hundredth of |xᵀKx|? Beside stiff parts it is below the rounding of K.
bool has_no_potential(Mat tangent, Vec motion) {
  constexpr double part = 0.01;
  Owned<Vec> forces, turned;
  for (Owned<Vec>* vector : {&forces, &turned}) check_petsc(VecDuplicate(motion, vector->out()));
  check_petsc(MatMult(tangent, motion, forces));
  check_petsc(MatMultTranspose(tangent, motion, turned));
  PetscScalar energy = 0;
  check_petsc(VecDot(motion, forces, &energy));
  check_petsc(VecAXPY(turned, -1, forces));
  check_petsc(VecPointwiseMult(turned, turned, motion));
  PetscReal lost = 0;
  check_petsc(VecNorm(turned, NORM_1, &lost));
  return lost > part * std::abs(energy);
}

/// Number of directions in which the equilibrium is unstable; nothing if its tangent does not tell.
std::optional<int> examine(SolverContext& context, const Configuration& equilibrium) {
  Configuration rested;
  move_and_rest(context, equilibrium, std::vector<double>(context.motion.size(), 0.0), rested);
  TangentFactors factors(context.assembler.new_matrix());
  context.assembler.tangent(rested, {1, 0, 0}, factors.matrix());
  leave_out_released(context, factors.matrix());
  if (!factors.factor() || !factors.symmetric()) return {};
  Owned<Vec> load, motion;
  for (Owned<Vec>* vector : {&load, &motion}) *vector->out() = context.assembler.new_vector();
  fill_loads(context.assembler, load);
  factors.solve(load, motion);
  if (relative_stiffness(context.assembler, factors.matrix(), motion, load) <= neutral) return {};
  if (has_no_potential(factors.matrix(), motion)) return {};
  return unstable_directions(context, factors.negative(), true);
}

}  // namespace

int unstable_directions(const SolverContext& context, int negative, bool symmetric) {
  const std::vector<Unknown>& unknowns = context.numbering.unknowns();
  const auto constraints =
      static_cast<int>(std::count_if(unknowns.begin(), unknowns.end(), [&](const Unknown& u) { return u.multiplier; }));
  // each of them turns the sign of the determinant
  return symmetric ? negative - constraints : (negative + constraints) % 2;
}

StabilityWatch::StabilityWatch(SolverContext& context)
    : context_(context),
      active_(context.options.analysis == SolverOptions::Analysis::statics && !context.options.path.follow &&
              !context.newton.keeps_one_tangent() && context.numbering.equations() <= most_equations),
      due_(context.options.begin + (context.options.end - context.options.begin) / looks) {}

void StabilityWatch::take(const Configuration& equilibrium, bool last) {
  if (!active_ || unstable_at_ || (equilibrium.time < due_ && !last)) return;
  const double begin = context_.options.begin, span = context_.options.end - begin;
  while (due_ <= equilibrium.time && span > 0) due_ += span / looks;
  const std::optional<int> found = examine(context_, equilibrium);
  if (!found || *found <= 0) return;
  unstable_at_ = equilibrium.time;
  directions_ = *found;
}

std::string StabilityWatch::remark() const {
  if (!unstable_at_) return {};
  return fmt::format(
      "the equilibrium at t = {:.6g} is unstable in {}: the slightest disturbance makes the structure leave it. .PATH finds the "
      "load at which stability is lost and the equilibria beyond it; .BUCKLING gives buckling loads and modes. A small lateral "
      "load also lets load steps leave it",
      *unstable_at_, directions_ == 1 ? "1 direction" : fmt::format("{} directions", directions_));
}

}  // namespace engrane::solve
