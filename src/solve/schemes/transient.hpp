// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "math/extrapolation.hpp"
#include "solve/constraints/constraint_changes.hpp"
#include "solve/schemes/dynamics.hpp"

namespace engrane::solve {

/// Coefficients of a one-step second-order scheme of the generalised-α family.
struct AlphaScheme {
  double alpha_m = 0, alpha_f = 0, beta = 0.25, gamma = 0.5;

  /// Chung and Hulbert (1993): spectral radius ρ∞ at infinite frequency, 0 to 1.
  static AlphaScheme chung(double rho);
  /// Newmark's trapezoidal rule: no damping.
  static AlphaScheme newmark();
  /// Hilber, Hughes and Taylor (1977), α from 0 to 1/3.
  static AlphaScheme hht(double alpha);
  /// Wood, Bossak and Zienkiewicz (1980), α from 0 to 1/3 (given positive).
  static AlphaScheme bossak(double alpha);

  /// Root mean square of the accelerations that independent errors of imposed positions cause, over that of the accelerations
  /// that one step would make of them. Each step hands what they leave to the next ones, with the sign changed.
  double gain_of_noise() const;
};

/// Generalised-α on the Lie group, constraints at index 3 (Arnold and Brüls 2007; Brüls, Cardona and Arnold 2012).
/// The unknowns of a step are λ and the corrections of its predicted increments h Δq (rotation vectors, positions, scalars),
/// or the increments themselves where predictions leave the model.
class Transient final : public Dynamics {
 public:
  explicit Transient(SolverContext& context);

  Outcome attempt(const Configuration& from, double h, Configuration& to) override;
  void accept() override;
  int order_of_error() const override { return 2; }
  void save(Snapshot& snapshot) const override;
  void load(const Snapshot& snapshot) override;

 private:
  /// Starts the scheme's memory for steps of h from `c`, whose velocities and accelerations are consistent; the slope of v̇ is
  /// taken over `span`.
  void start_memory(const Configuration& c, double h, double span, const MasslessMotions* massless);
  void start_memory(const Configuration& c, const MasslessMotions* massless) override;
  void restart_memory(Configuration& c) override;
  /// d/dt of v̇ at `c`, from balances over the time `span`, softened for steps of h.
  std::vector<double> slope_of_accelerations(const Configuration& c, double h, double span,
                                             const MasslessMotions* massless) const;

  /// Velocities with which a step of h from `from` begins: those of the scheme, which differ from consistent ones by a part
  /// that grows with the square of the step.
  std::vector<double> first_velocities(const Configuration& from, double h);
  /// Restarts the memory at the end of a step, for one that is much longer: differences over the short one are rounding.
  /// Returns the accelerations that it begins with.
  std::vector<double> renew_memory(const Configuration& from, double h);
  /// Outcome::error of a converged step of h that began with the scheme's accelerations `a0`.
  std::optional<double> local_error(std::span<const double> a0, double h, const Configuration& to);
  /// Whether an increment is as large as the model, or a radian.
  bool leaves(std::span<const double> increments) const;

  AlphaScheme scheme_;
  ConstraintChanges changes_;
  double step_of_algorithmic_ = 0;   ///< the h that `algorithmic_` belongs to
  std::vector<double> algorithmic_;  ///< a_n of the scheme: v̇ shifted by (α_m − α_f) h
  /// Consistent velocities where the next step begins, empty if they are the configuration's own; and the difference of the
  /// scheme's velocities from them, for a step of step_of_algorithmic_. Both are empty until they are needed.
  std::vector<double> fitting_, offset_;
  std::vector<double> tried_;  ///< `algorithmic_` at the end of the last attempt
  double tried_step_ = 0;
  Extrapolation accelerations_{3, 2}, multipliers_{3, 2};  ///< of `algorithmic_` and kλ, at ends of steps since the last event
  std::vector<double> tried_multipliers_;                  ///< at the end of the last attempt
  double tried_time_ = 0;
};

}  // namespace engrane::solve
