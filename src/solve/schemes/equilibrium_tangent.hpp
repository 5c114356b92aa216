// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "solve/algebra/tangent_factors.hpp"
#include "solve/schemes/solver_context.hpp"

namespace engrane::solve {

/// The tangent at an equilibrium and its factors: of forces at rest, with rotations as increments that start there, and without
/// the columns of released constraints, whose multipliers do not change. It is then symmetric if all loads have a potential,
/// and its negative eigenvalues tell in how many directions the equilibrium is unstable, beside redundant constraints too.
class EquilibriumTangent {
 public:
  explicit EquilibriumTangent(SolverContext& context);

  /// Evaluates the tangent of any state like that of an equilibrium, in a matrix from Assembler::new_matrix(). Collective.
  /// `change`: Assembler::tangent().
  void evaluate(const Configuration& at_start_of_step, Mat into, const Assembler::Change& change = {}) const;
  /// Evaluates and factors it at an equilibrium; false if it is singular to the last digit. Collective.
  bool factor(const Configuration& equilibrium);
  /// Whether some motion meets no resistance but rounding: the sign of an eigenvalue is then unknown. Sets `motion` to the
  /// answer to generic loads, which is all but the softest motion. Collective.
  bool neutral(Vec motion);

  Mat matrix() const { return factors_.matrix(); }
  void solve(Vec right, Vec solution) { factors_.solve(right, solution); }
  /// TangentFactors::negative() and symmetric().
  int negative() const { return factors_.negative(); }
  bool symmetric() const { return factors_.symmetric(); }
  /// The equilibrium, with increments of rotations that start there.
  const Configuration& place() const { return place_; }

 private:
  SolverContext& context_;
  TangentFactors factors_;
  Configuration place_;
  Owned<Vec> loads_;  ///< made by the first neutral()
};

/// Number of directions in which an equilibrium is unstable, by the negative eigenvalues of its tangent: each constraint,
/// released or not, adds one to them. Of an unsymmetric tangent 1 if the number is odd, else 0.
int unstable_directions(const SolverContext& context, int negative, bool symmetric);

}  // namespace engrane::solve
