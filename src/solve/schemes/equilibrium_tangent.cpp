// SPDX-License-Identifier: BSD-3-Clause
#include "solve/schemes/equilibrium_tangent.hpp"

#include <algorithm>
#include <vector>

#include "solve/algebra/probe.hpp"

namespace engrane::solve {

EquilibriumTangent::EquilibriumTangent(SolverContext& context) : context_(context), factors_(context.assembler.new_matrix()) {}

void EquilibriumTangent::evaluate(const Configuration& at_start_of_step, Mat into, const Assembler::Change& change) const {
  Assembler& assembler = context_.assembler;
  assembler.tangent(at_start_of_step, {1, 0, 0}, into, change);
  if (assembler.half()) return;  // there are no constraints
  const Numbering& numbering = context_.numbering;
  std::vector<PetscInt> rows;
  for (int row = numbering.first_row(); row < numbering.end_row(); ++row)
    if (const Unknown& u = numbering.unknown(row); u.multiplier && assembler.released(u.slot - numbering.motion_slots()))
      rows.push_back(row);
  check_petsc(MatZeroRowsColumns(into, static_cast<PetscInt>(rows.size()), rows.data(), -1, nullptr, nullptr));
}

bool EquilibriumTangent::factor(const Configuration& equilibrium) {
  place_ = at_start_of_step(equilibrium);
  evaluate(place_, factors_.matrix());
  return factors_.factor();
}

bool EquilibriumTangent::neutral(Vec motion) {
  constexpr double least = 1e-13;  // stiffness of the softest motion beside what its unknowns meet one by one
  if (!loads_) *loads_.out() = context_.assembler.new_vector();
  fill_loads(context_.assembler, loads_);
  factors_.solve(loads_, motion);
  return relative_stiffness(context_.assembler, factors_.matrix(), motion, loads_) <= least;
}

int unstable_directions(const SolverContext& context, int negative, bool symmetric) {
  const std::vector<Unknown>& unknowns = context.numbering.unknowns();
  const auto constraints =
      static_cast<int>(std::count_if(unknowns.begin(), unknowns.end(), [&](const Unknown& u) { return u.multiplier; }));
  // each of them turns the sign of the determinant
  return symmetric ? negative - constraints : (negative + constraints) % 2;
}

}  // namespace engrane::solve
