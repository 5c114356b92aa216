// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <functional>
#include <string>
#include <vector>

#include "assembly/assembler.hpp"
#include "base/snapshot.hpp"
#include "solve/algebra/factor_frames.hpp"
#include "solve/algebra/factor_policy.hpp"
#include "solve/algebra/imbalance.hpp"
#include "solve/algebra/linear.hpp"

namespace engrane::solve {

/// One line of a Newton table. All values are relative (References): forces and moments to the loads, constraint violations and
/// corrections to the lengths.
struct NewtonRow {
  int iteration = 0;
  double force = 0, moment = 0, length = 0, angle = 0;
  double correction = 0;  ///< largest change of a position or of an angle by the previous iteration
  int worst = -1;         ///< equation with the largest relative residual
};

struct NewtonReport {
  bool converged = false;
  bool singular = false;
  bool conflict = false;    ///< constraints that were taken to be redundant could not be satisfied
  bool unresisted = false;  ///< nothing resists some motion of the equilibrium that was found (Statics)
  bool coupled = false;     ///< all stages of a step were solved together, each with its own tangents (CoupledStages)
  int iterations = 0;
  std::string reason;  ///< why it did not converge, in words
  std::vector<NewtonRow> rows;
};

/// One more unknown and one more equation beside those of the matrix. Newton corrections are made with the matrix alone and
/// then completed for them (block elimination of the bordered system; Keller 1977, in Applications of Bifurcation Theory).
class Border {
 public:
  virtual ~Border() = default;
  /// `step` is the correction with the other unknown fixed; the next point is x − step.
  virtual void complete(Vec x, Vec step) = 0;
  /// Whether the last change of the other unknown was at most this part of its size.
  virtual bool has_settled(double part) const = 0;
};

/// Newton's method (PETSc's SNES) on the assembled system, with a convergence test that distinguishes forces from lengths.
class Newton {
 public:
  /// Sets the configuration that belongs to the unknowns; its multipliers are kλ = k × unknown.
  using Apply = std::function<void(std::span<const double> unknowns, Configuration& configuration)>;

  Newton(Assembler& assembler, LinearSolver& solver, double precision, int iterations);

  /// Solves r = 0 from the guess `x`, which it overwrites; `work` ends as the last configuration tried. `keep`: tangent and
  /// factors of earlier solutions are reused as long as that pays; otherwise iterations have their own tangents.
  NewtonReport solve(Vec x, Weights weights, bool keep, const Apply& apply, Configuration& work, Border* border = nullptr);

  /// From now on all solutions share one tangent and its factors: that of a linear model never changes.
  void keep_one_tangent() { one_tangent_ = true; }
  bool keeps_one_tangent() const { return one_tangent_; }
  /// To be called if the last solution is refused although the iteration has converged: its forces are no reference for later
  /// ones.
  void refuse_last();
  /// Loads so far that residuals are compared with, and the same put back where several solutions in turn were not the right
  /// ones.
  const std::vector<double>& loads() const { return references_.memory(); }
  void restore_loads(std::vector<double> loads) { references_.restore(std::move(loads)); }
  /// Makes the next solution take at least two corrections. The second costs little, since both share the factors, and recovers
  /// the digits lost to rounding in them. With an iterative solver it would cost as much as the first and is left out.
  void refine_next() { refined_ = true; }
  /// Limits the constraint violations that the next solution leaves to this fraction of their length, or of a radian.
  void close_next(double open) { open_ = open; }

  /// The loads and lengths that residuals were compared with.
  const References& references() const { return references_; }
  /// Reference length of a constraint: that of positions, or 1 radian.
  double length(int multiplier) const { return references_.length(equation(multiplier)); }
  /// Force kΦ of a constraint that is open by this much, over the largest loads so far around it.
  double relative_force(int multiplier, double open) const {
    return assembler_.scale()[static_cast<std::size_t>(multiplier)] * open / references_.peak(equation(multiplier));
  }

  /// The largest loads so far, which are references of residuals, and the kept factors, for a restart.
  void save(Snapshot& snapshot) const;
  void load(const Snapshot& snapshot);

 private:
  static PetscErrorCode form_function(SNES, Vec x, Vec f, void* self);
  static PetscErrorCode before_solution(KSP, Vec right, Vec solution, void* self);
  static PetscErrorCode after_solution(KSP, Vec right, Vec solution, void* self);
  static PetscErrorCode test_convergence(SNES, PetscInt iteration, PetscReal, PetscReal, PetscReal, SNESConvergedReason* reason,
                                         void* self);
  static PetscErrorCode change_step(SNESLineSearch, Vec x, Vec step, PetscBool* changed, void* self);
  bool keep_sliding(Vec x, Vec step);
  /// Sliding velocities of all regularised frictions (Element::sliding) in work_.
  std::vector<Vec3> sliding() const;
  int equation(int multiplier) const {
    return assembler_.numbering().equation(assembler_.numbering().motion_slots() + multiplier);
  }
  /// Decides whether the next correction uses the present factors, and makes a tangent for new ones if not.
  void choose_factors();
  void make_tangent();
  /// Whether the tangent of the last correction is good enough for the next one.
  bool tangent_serves_again() const;
  bool judge(int iteration);
  /// Whether every force left in the residual is within the rounding of positions, so that nothing better can be found.
  /// Collective.
  bool left_to_rounding() const;
  /// Whether forces at rest are balanced beside those at hand. Those that an iteration tried on its way are a reference for
  /// rounding alone, which is left when positions no longer change.
  bool balanced_by_itself();

  Assembler& assembler_;
  LinearSolver& solver_;
  double precision_;
  int iterations_;
  Owned<SNES> snes_;
  Owned<Vec> residual_, trial_;
  std::vector<int> sliding_parts_;  ///< elements with regularised friction
  const Apply* apply_ = nullptr;
  Configuration* work_ = nullptr;
  Border* border_ = nullptr;
  Weights weights_, weights_of_factors_;
  bool keep_ = false;
  std::vector<double> loads_before_;  ///< References::memory() before the last solution; empty if it had nothing
  bool one_tangent_ = false;
  bool refined_ = false;
  double open_ = 1;  ///< of close_next()
  FactorPolicy policy_;
  FactorFrames frames_;
  bool solving_ = false;         ///< in solve(): for other users the solver takes its factors as they are
  bool fresh_ = true;            ///< factors are those of the last residual's configuration
  long matrix_of_factors_ = -1;  ///< Assembler::changes() when the factored tangent was made
  int uses_ = 0;                 ///< corrections of this solution with the last tangent
  double changed_ = 0;           ///< relative change by the last correction, multipliers included
  double evaluation_ = 0;        ///< estimated instructions of a residual
  References references_;
  NewtonRow row_;
  Imbalance imbalance_;  ///< of the last residual
  std::vector<NewtonRow> rows_;
  std::exception_ptr failure_;  ///< thrown inside a callback
};

}  // namespace engrane::solve
