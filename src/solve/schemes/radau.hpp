// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "math/extrapolation.hpp"
#include "solve/algebra/references.hpp"
#include "solve/schemes/coupled_stages.hpp"
#include "solve/schemes/dynamics.hpp"
#include "solve/schemes/end_projection.hpp"
#include "solve/schemes/kept_matrices.hpp"
#include "solve/schemes/lost_vibrations.hpp"
#include "solve/schemes/stage_motion.hpp"
#include "solve/schemes/stage_solver.hpp"

namespace engrane::solve {

/// Radau IIA with three stages, on coordinates of the step: rotation vectors, displacements and scalars from its beginning
/// (Munthe-Kaas 1999, for collocation). The constraints are closed at the stages (index 3). The end of a step is then given
/// consistent velocities, accelerations and multipliers (Jay 1995), so that all of them are of order 5.
class Radau final : public Dynamics {
 public:
  explicit Radau(SolverContext& context);

  StartReport start(Configuration& c) override;
  Outcome attempt(const Configuration& from, double h, Configuration& to) override;
  void accept() override;
  void drift(Configuration& c, double h) override;
  void enter(const std::vector<int>& sides) override;
  int order_of_error() const override { return static_cast<int>(collocation_.stages()); }
  const References& references() const override { return references_; }
  const LostVibrations* lost_vibrations() const override { return lost_ ? &*lost_ : nullptr; }
  void save(Snapshot& snapshot) const override;
  void load(const Snapshot& snapshot) override;
  /// Velocities of generalised-α oscillate about the values that satisfy the constraints, long after a jump of a drive's speed.
  bool takes_velocities(const Snapshot& snapshot) const override { return !snapshot.has("scheme/algorithmic"); }

 private:
  bool restore_balance(Configuration& c) override;
  /// Moves `c` by the kept matrices until its forces balance, with at most `most` corrections; a single one (`most` = 1) is not
  /// checked. False if they do not lead there.
  bool balance_near(Configuration& c, int most);
  /// Corrects accelerations along constraints, by the kept matrices, to those that keep these closed. False if that fails.
  bool fit_along_constraints(Configuration& c);
  void start_memory(const Configuration& c, const MasslessMotions* massless) override;
  void restart_memory(Configuration& c) override;

  /// A step and the estimate of its error.
  struct Judged {
    double step = 0, error = 0;
  };
  /// State at the end of a step.
  struct End {
    double time = 0;
    std::vector<double> v, a, multipliers;
    double open = 0;  ///< largest constraint violation, over a length or in radians
    Judged judged;
  };
  /// When to begin steps with coupled stages: after several steps in a row on which the simplified iteration failed, more and
  /// more of them.
  struct Coupled {
    double step = 0;  ///< the last that needed them
    int tries = 0;    ///< failures since the simplified iteration last converged
    int left = 0;     ///< number of steps still to begin with them
  };
  /// Predicts the stages of a step.
  void predict(const Configuration& from, double h);
  /// Sets the stages' configurations, evaluates their residuals and compares these with the references.
  Imbalance evaluate(const Configuration& from);
  /// Outcome::error of a step of h that has converged; `coupled`: with the tangents of each stage.
  double local_error(const Configuration& from, double h, const Configuration& to, bool coupled);
  /// Rounding of each unknown at a stage, by equation. What drives prescribe is rounded by the way travelled so far, such as an
  /// angle of many turns.
  std::vector<double> rounding_of_stage(std::size_t i) const;
  /// Whether a correction of positions this large, over the lengths around, is rounding; `contraction` is it over the one before.
  bool rests(double motion, double contraction) const;
  /// Whether every force left in the residuals of a step of h is within the rounding of positions, so that nothing better can be
  /// found. Collective.
  bool left_to_rounding(double h, const CoupledStages* exact) const;
  /// Largest displacement of the present step, over the lengths around or in radians.
  double increment() const;
  /// Largest change of a displacement, over the lengths around or in radians, and of a multiplier, as such a displacement or
  /// over the loads around.
  struct Correction {
    double motion = 0, forces = 0;
  };
  /// Adds the last changes to the stages.
  Correction correct();
  /// Discards what steps are predicted from.
  void forget_motion();
  /// Notes how far open a drift has left the constraints of `c`.
  void leaves_open(const Configuration& c);
  void forget() {
    forget_motion();
    kept_.clear();
  }
  /// Evaluates the matrices at `c` for steps of h. They are kept as long as the iteration converges fast with them, and for
  /// controlled steps of other lengths and after other events too.
  void keep(const Configuration& c, double h);
  /// Forms the systems for steps of h from kept matrices; false if there are none.
  bool recall(double h);
  /// Newton's iteration from the stages in now_: simplified, with the kept matrices, or with the tangents of each stage
  /// (`exact`).
  NewtonReport iterate(const Configuration& from, double h, CoupledStages* exact = nullptr);
  /// Finds the stages of a step, in now_: with the kept matrices, or with the tangents of each stage if these do not converge.
  NewtonReport find_stages(const Configuration& from, double h);
  /// Gives the end of a step its velocities, accelerations and multipliers; false if they are not determined.
  bool fit_end(Configuration& c);
  /// Masses times these accelerations of nodes, by motion slot; empty if there are no matrices.
  std::vector<double> inertia_of(std::span<const double> accelerations);

  Extrapolation accelerations_, multipliers_;  ///< at the ends of steps since the last event
  Collocation collocation_;
  StageSolver solver_;
  References references_;
  StageMotion now_;                                  ///< of the present step
  double weight_of_places_;                          ///< sum of the weights of stages in the embedded formula, by magnitude
  double weight_of_closing_;                         ///< the same for velocities, where all stages move by as much
  double open_ = 0;                                  ///< End::open of the last accepted step
  double drifted_open_ = 0;                          ///< the same after a drift, until the next step
  Judged judged_;                                    ///< the last accepted step; step 0: none since the last event
  End tried_;                                        ///< of the last attempt
  std::vector<double> last_change_, change_before_;  ///< the last two corrections of the end of the step, by motion slot
  std::vector<Configuration> configurations_;
  std::vector<Owned<Vec>> residuals_, changes_;
  KeptMatrices kept_;
  std::optional<LostVibrations> lost_;             ///< if an estimate of the error is wanted
  std::unique_ptr<CoupledStages> coupled_stages_;  ///< made by the first step that needs it
  Coupled coupled_;
  double kept_step_ = 0;      ///< for which the systems may be reused; 0: none
  double matrices_step_ = 0;  ///< for which they were last made; 0: never
  bool factored_ = false;     ///< the solver has their factors, and so it would after a restart at the beginning of the step
  std::vector<double> kept_scale_;
  EndProjection projection_;
  bool fine_forces_;  ///< of the model
};

}  // namespace engrane::solve
