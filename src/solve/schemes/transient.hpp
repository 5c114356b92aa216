// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "solve/constraints/constraint_changes.hpp"
#include "solve/schemes/extrapolation.hpp"
#include "solve/schemes/scheme.hpp"

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
};

/// Generalised-α on the Lie group, constraints at index 3 (Arnold and Brüls 2007; Brüls, Cardona and Arnold 2012).
/// Unknowns of a step are its increments h Δq (rotation vectors, positions, scalars) and λ/k.
class Transient final : public Scheme {
 public:
  explicit Transient(SolverContext& context);

  StartReport start(Configuration& c) override;
  Outcome attempt(const Configuration& from, double h, Configuration& to) override;
  void accept() override;
  bool meets_events() const override { return true; }
  void drift(Configuration& c, double h) override;
  bool settle_friction(Configuration& c) override;
  void take_over(Configuration& c) override { settle_friction(c); }
  void save(Snapshot& snapshot) const override;
  void load(const Snapshot& snapshot) override;

 private:
  /// Starts the scheme's memory for steps of h from `c`, whose velocities and accelerations fit; the slope of v̇ is taken over
  /// `span`.
  void start_memory(const Configuration& c, double h, double span, const MasslessMotions* massless);
  /// The same after an event.
  void restart_memory(const Configuration& c);
  /// d/dt of v̇ at `c`, from what balance gives over the time `span`.
  std::vector<double> slope_of_accelerations(const Configuration& c, double span, int iterations,
                                             const MasslessMotions* massless) const;

  /// The velocities with which a step of h from `from` begins: those of the scheme, which differ from the ones that fit the
  /// constraints by a part that grows with the square of the step.
  std::vector<double> first_velocities(const Configuration& from, double h);
  /// Starts the memory anew from the end of a step for one that is much longer: differences of the short one are rounding.
  void renew_memory(const Configuration& from, double h);
  /// Are changes of `rates` more than rounding: times `scale` displacements larger than that of places, or larger than a `share`
  /// of the largest of the rates themselves?
  bool counts(std::span<const double> changes, double scale, std::span<const double> rates, double share) const;
  bool constrained() const;
  /// Is an increment as large as the model, or a radian?
  bool leaves(std::span<const double> increments) const;
  /// The velocities of `c` changed, in kinetic energy as little as possible, until they fit its constraints; the same where that
  /// is rounding, or where none fit.
  std::vector<double> fitting_velocities(const Configuration& c) const;

  /// What balance asks of motions without mass at one instant.
  struct Relaxed {
    std::vector<double> jump;   ///< of springs: to where their forces balance; one entry per motion slot
    std::vector<double> speed;  ///< of dampers: what is to be added to the velocity
  };
  /// Moves what has no mass to where its forces balance, while all else stands still. Velocities and accelerations of `c` stay.
  /// Both results are the parts along the massless motions where `c` then is; `massless` becomes these.
  Relaxed relax(Configuration& c, MasslessMotions& massless);
  /// Positions, velocities and accelerations of motions without mass that fit their balance at the start and a little later.
  void settle(Configuration& c, MasslessMotions& massless, StartReport& report);

  /// The motions without mass at `c`, or nullptr where the model has none; valid until the next call.
  const MasslessMotions* massless_at(const Configuration& c);

  /// Gives `c` the multipliers that balance it at its own instant.
  void refine_grips(Configuration& c);

  /// `c` moved by h with the accelerations it has; these and the multipliers do not change.
  Configuration glide(const Configuration& c, double h) const;

  AlphaScheme scheme_;
  ConstraintChanges changes_;
  Owned<Vec> unknowns_;
  double step_of_algorithmic_ = 0;   ///< the h that `algorithmic_` belongs to
  double scaled_for_ = 0;            ///< the h that k was chosen for
  std::vector<double> algorithmic_;  ///< a_n of the scheme: v̇ shifted by (α_m − α_f) h
  /// Velocities that fit where the next step begins, empty where they are the configuration's own; and what the scheme's differ
  /// by from them, for a step of step_of_algorithmic_. Both empty where nobody has asked.
  std::vector<double> fitting_, offset_;
  std::vector<double> tried_;  ///< `algorithmic_` at the end of the last attempt
  double tried_step_ = 0;
  Extrapolation accelerations_, multipliers_;  ///< of `algorithmic_` and λ, at the ends of steps since the last event
  std::vector<double> tried_multipliers_;      ///< at the end of the last attempt
  double tried_time_ = 0;
  bool has_massless_ = false;  ///< the model has motions without mass
  std::optional<MasslessMotions> massless_;
};

}  // namespace engrane::solve
