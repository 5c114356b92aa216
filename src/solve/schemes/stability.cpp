// SPDX-License-Identifier: BSD-3-Clause
#include "solve/schemes/stability.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/linear_statics.hpp"
#include "solve/schemes/equilibrium_tangent.hpp"

namespace engrane::solve {

namespace {

/// Equilibria examined beside the last.
constexpr int looks = 8;
/// Largest number of equations: the factors of larger ones take a good part of the memory.
constexpr int most_equations = 50000;

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

/// Whether forces of elements are linear in rotation vectors, as with small displacements. Their tangent by rotations that start
/// at the equilibrium is that of no potential; their own, at rest, is positive.
bool has_linear_rotations(const Model& model) {
  return has_linear_forces(model) || std::any_of(model.parts.begin(), model.parts.end(), [](const Model::Part& part) {
           const Layout& layout = part.element->layout();
           bool turns = false;
           for (std::size_t i = 0; i < layout.needs.size(); ++i) turns = turns || layout.needs_any(i, NodeNeed::rotation);
           return turns && part.element->is_linear();
         });
}

/// Number of directions in which the equilibrium is unstable; nullopt if its tangent is singular or has no potential.
std::optional<int> examine(SolverContext& context, const Configuration& equilibrium) {
  EquilibriumTangent tangent(context);
  if (!tangent.factor(equilibrium) || !tangent.symmetric()) return {};
  Owned<Vec> motion;
  *motion.out() = context.assembler.new_vector();
  if (tangent.neutral(motion) || has_no_potential(tangent.matrix(), motion)) return {};
  return unstable_directions(context, tangent.negative(), true);
}

}  // namespace

StabilityWatch::StabilityWatch(SolverContext& context)
    : context_(context),
      active_(context.options.analysis == SolverOptions::Analysis::statics && !context.options.path.follow &&
              !has_linear_rotations(context.model) && context.numbering.equations() <= most_equations),
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
