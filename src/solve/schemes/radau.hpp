// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "math/extrapolation.hpp"
#include "solve/algebra/references.hpp"
#include "solve/schemes/coupled_stages.hpp"
#include "solve/schemes/dynamics.hpp"
#include "solve/schemes/kept_matrices.hpp"
#include "solve/schemes/stage_solver.hpp"

namespace engrane::solve {

/// Radau IIA of three stages on coordinates of the step: rotation vectors, displacements and scalars from where it begins
/// (Munthe-Kaas 1999, for collocation). Stages have their constraints closed (index 3); the end of a step is then given the
/// velocities, accelerations and multipliers that fit (Jay 1995), so that all of them are of order 5.
class Radau final : public Dynamics {
 public:
  explicit Radau(SolverContext& context);

  StartReport start(Configuration& c) override;
  Outcome attempt(const Configuration& from, double h, Configuration& to) override;
  void accept() override;
  void drift(Configuration& c, double h) override;
  void enter(const std::vector<int>& sides) override;
  int order_of_error() const override { return static_cast<int>(collocation_.stages()); }
  void save(Snapshot& snapshot) const override;
  void load(const Snapshot& snapshot) override;

 private:
  bool restore_balance(Configuration& c) override;
  /// Moves `c` by the matrices kept until its forces balance, or once where that is the most; false where these do not lead
  /// there.
  bool balance_near(Configuration& c, int most);
  void start_memory(const Configuration& c, const MasslessMotions* massless, bool softened) override;
  void restart_memory(Configuration& c) override;

  /// The motion of a step, one entry for each stage.
  struct Stages {
    std::vector<std::vector<double>> y, v, a;      ///< by motion slot
    std::vector<std::vector<double>> multipliers;  ///< kλ
  };
  /// Where a step ended.
  struct End {
    double time = 0;
    std::vector<double> a, multipliers;
    double open = 0;  ///< the largest part of a length, or of a radian, that constraints are open by
  };
  /// What steps have told of the tangents of each stage: where others failed several times in a row, more and more steps begin
  /// with these.
  struct Coupled {
    double step = 0;  ///< the last that needed them
    int tries = 0;    ///< that have failed since others served
    int left = 0;     ///< steps to begin with them
  };
  /// A first guess of the stages of a step.
  void predict(const Configuration& from, double h);
  /// Velocities and accelerations of the stages from y, with what is prescribed.
  void differentiate(const Configuration& from, double h);
  /// Sets the stages' configurations, evaluates their residuals and compares these with the references.
  Imbalance evaluate(const Configuration& from);
  /// Outcome::error of a step of h that has converged.
  std::optional<double> local_error(const Configuration& from, double h, const Configuration& to);
  /// The largest displacement of the step as it is now, over the lengths around or in radians.
  double increment() const;
  /// The largest change of a displacement, over the lengths around or in radians, and of a multiplier, as that displacement or
  /// over the loads around.
  struct Correction {
    double motion = 0, forces = 0;
  };
  /// Adds the last changes to the stages.
  Correction correct();
  /// What is to foretell steps is forgotten.
  void forget_motion();
  void forget() {
    forget_motion();
    kept_.clear();
  }
  /// Evaluates the matrices at `c` for steps of h; they serve as long as the iteration is quick with them, controlled steps of
  /// other lengths and behind other events too.
  void keep(const Configuration& c, double h);
  /// The systems of steps of h from matrices that are kept; false when there are none.
  bool recall(double h);
  /// Newton's iteration from the stages in now_: simplified, with the matrices that are kept, or with the tangents of each stage.
  NewtonReport iterate(const Configuration& from, double h, CoupledStages* exact = nullptr);
  /// The stages of a step, in now_: by the matrices that are kept, or by the tangents of each stage where those lead nowhere.
  NewtonReport find_stages(const Configuration& from, double h);
  /// Velocities, accelerations and multipliers that fit at the end of a step whose positions fit; false when there are none.
  bool complete(Configuration& c);
  /// The first of these, and the others.
  bool fit_velocities(Configuration& c);
  bool fit_accelerations(Configuration& c);
  /// A part of what is there already that the two need not be corrected by.
  double least_correction() const;
  /// Is a correction of velocities or accelerations, by motion slot, more than that of the largest of them, over the length of
  /// the model or in radians?
  bool worth(std::span<const double> change, std::span<const double> rates) const;
  /// Makes the matrix of these at `c`. Controlled steps keep it as long as the iteration is quick with it.
  void renew_balance(const Configuration& c);
  /// The change of the motion (by slot) and of multipliers (by equation) that right_side_ asks for; false when singular.
  bool solve_balance(std::vector<double>& change, std::span<const double>& found);
  bool has_equation(std::size_t slot) const { return context_.numbering.equation(static_cast<int>(slot)) >= 0; }

  Extrapolation accelerations_, multipliers_;  ///< at the ends of steps since the last event
  Collocation collocation_;
  StageSolver solver_;
  References references_;
  Stages now_;                                       ///< of the present step
  double weight_of_places_;                          ///< in the embedded formula, which tells a step's error
  double open_ = 0;                                  ///< End::open of the last accepted step
  End tried_;                                        ///< of the last attempt
  std::vector<double> last_change_, change_before_;  ///< the last two corrections of the end of the step, by motion slot
  std::vector<Configuration> configurations_;
  std::vector<std::vector<MotionSlots::Prescribed>> prescribed_;
  std::vector<Owned<Vec>> residuals_, changes_;
  KeptMatrices kept_;
  std::unique_ptr<CoupledStages> coupled_stages_;  ///< from the first step on that needs it
  Coupled coupled_;
  double kept_step_ = 0;      ///< that the systems are worth trying for; 0: none
  double matrices_step_ = 0;  ///< that they were last made for; 0: never
  std::vector<double> kept_scale_;
  bool fresh_ = false;  ///< they were evaluated in the last attempt
  bool has_friction_ = false;
  Owned<Mat> balance_matrix_;
  LinearSolver balance_;
  bool balance_kept_ = false;       ///< its matrix is worth trying
  bool balance_fits_ = false;       ///< and was made at this very place
  std::vector<double> right_side_;  ///< by equation
  Owned<Vec> right_, solution_;
};

}  // namespace engrane::solve
