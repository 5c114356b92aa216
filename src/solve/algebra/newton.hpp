// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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

/// One line of a Newton table, all relative to what is there (References): forces and moments to the loads, open constraints and
/// corrections to the lengths.
struct NewtonRow {
  int iteration = 0;
  double force = 0, moment = 0, length = 0, angle = 0;
  double correction = 0;  ///< largest change of a position or of an angle, of the iteration before
  int worst = -1;         ///< equation with the largest relative residual
};

struct NewtonReport {
  bool converged = false;
  bool singular = false;
  bool conflict = false;  ///< constraints could not be met that the solver took for consequences of the others
  bool coupled = false;   ///< all stages of a step, each with its own tangents (CoupledStages)
  int iterations = 0;
  std::string reason;  ///< why it did not converge, in words
  std::vector<NewtonRow> rows;
};

/// One more unknown and one more equation beside those of the matrix: Newton's corrections, which are made with the matrix alone,
/// are completed for them (block elimination of the bordered system; Keller 1977, in Applications of Bifurcation Theory).
class Border {
 public:
  virtual ~Border() = default;
  /// `step` is the correction with the other unknown as it is; the next point is x − step.
  virtual void complete(Vec x, Vec step) = 0;
};

/// PETSc's SNES on the assembled system, with a convergence test that knows forces from lengths.
class Newton {
 public:
  /// Writes the configuration that belongs to the unknowns; multipliers come scaled, λ = unknown × k.
  using Apply = std::function<void(std::span<const double> unknowns, Configuration& configuration)>;

  Newton(Assembler& assembler, LinearSolver& solver, double precision, int iterations);

  /// Solves r = 0 from the guess `x`, which it overwrites; `work` ends as the last configuration tried. `keep`: tangent and
  /// factors of earlier solutions serve as long as that pays; else each iteration makes its own.
  NewtonReport solve(Vec x, Weights weights, bool keep, const Apply& apply, Configuration& work, Border* border = nullptr);

  /// From now on one tangent and its factors serve all solutions: that of a linear model never changes.
  void keep_one_tangent() { one_tangent_ = true; }
  bool keeps_one_tangent() const { return one_tangent_; }
  /// The next solution is corrected at least twice: the second correction costs little beside the factors that both share, and
  /// gains the digits that rounding in them took. With an iterative solver it would cost as much as the first: it is left out.
  void refine_next() { refined_ = true; }
  /// The next solution leaves no constraint open by more than this part of its length, or of a radian.
  void close_next(double open) { open_ = open; }

  /// The largest force that an element has contributed so far.
  double largest_force() const { return references_.largest_force(); }

  /// What the residual of an equation was compared with last.
  double load(int equation) const { return references_.load(equation); }
  /// What corrections of an unknown are compared with: how far away its positions are counted, or 1 radian.
  double reach(int equation) const { return references_.length(equation); }
  /// The size of a constraint: of positions, or 1 radian.
  double length(int multiplier) const { return references_.length(equation(multiplier)); }
  /// The force kΦ of a constraint that is open by this much, over the largest loads so far around it.
  double relative_force(int multiplier, double open) const {
    return assembler_.scale()[static_cast<std::size_t>(multiplier)] * open / references_.peak(equation(multiplier));
  }

  /// The largest contributions so far, which residuals are compared with, and the factors kept, for a restart.
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
  /// Decides whether the next correction is made with the factors there are, and makes a tangent for new ones if not.
  void choose_factors();
  void make_tangent();
  /// Whether another tangent than that of the last correction would gain nothing that counts.
  bool tangent_serves_again() const;
  bool judge(int iteration);
  /// Whether what is left of every force of a linear model is no more than the rounding of positions makes: nothing better can be
  /// found. Collective.
  bool left_to_rounding() const;

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
  bool one_tangent_ = false;
  bool refined_ = false;
  double open_ = 1;  ///< of close_next()
  FactorPolicy policy_;
  FactorFrames frames_;
  bool solving_ = false;         ///< for others the solver takes its factors as they are
  bool fresh_ = true;            ///< factors are those of the last residual's configuration
  long matrix_of_factors_ = -1;  ///< Assembler::changes() when the tangent was made that the factors belong to
  int uses_ = 0;                 ///< corrections of this solution with the last tangent
  double changed_ = 0;           ///< by the last correction, multipliers too
  double evaluation_ = 0;        ///< instructions of a residual, about
  References references_;
  NewtonRow row_;
  Imbalance imbalance_;  ///< of the last residual
  std::vector<NewtonRow> rows_;
  std::string failure_;  ///< of an exception inside a callback
};

}  // namespace engrane::solve
