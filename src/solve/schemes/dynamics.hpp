// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "solve/schemes/scheme.hpp"
#include "solve/schemes/step_error.hpp"

namespace engrane::solve {

/// Common part of the schemes for dynamics: the start, motions without mass, events, and frictions that come to rest. A scheme
/// adds its steps and its memory of earlier ones.
class Dynamics : public Scheme {
 public:
  explicit Dynamics(SolverContext& context);

  StartReport start(Configuration& c) override;
  bool meets_events() const override { return true; }
  Configuration coast(const Configuration& c, double h) const override { return glide(c, h); }
  void drift(Configuration& c, double h) override;
  double drift_error(const Configuration& c, double h) override;
  std::optional<Configuration> settle_friction(Configuration& c) override;
  void take_over(Configuration& c) override;
  std::unique_ptr<Within> within(const Configuration& from, const Configuration& to, std::span<const double> scalars,
                                 bool drift) override;
  void save(Snapshot& snapshot) const override;
  void load(const Snapshot& snapshot) override;

 protected:
  /// Implements Within::balance().
  virtual bool restore_balance(Configuration& /*c*/) { return false; }

  /// Starts the scheme's memory from `c`, a solution at the start of the run.
  virtual void start_memory(const Configuration& c, const MasslessMotions* massless) = 0;
  /// Starts that memory again after an event, at which forces may set in; may change accelerations of `c` as soften() does.
  virtual void restart_memory(Configuration& c) = 0;

  /// Returns `c` moved by h with its velocities and accelerations; accelerations and multipliers do not change.
  Configuration glide(const Configuration& c, double h) const;
  /// Whether changes of `rates` are more than rounding: times `scale`, displacements larger than the rounding of positions; or
  /// larger than the fraction `share` of the largest of the rates.
  bool counts(std::span<const double> changes, double scale, std::span<const double> rates, double share) const;
  bool constrained() const;
  /// Returns the velocities of `c`, changed as little as possible in kinetic energy so that they satisfy the constraints;
  /// unchanged if the change is rounding, or if none satisfy them.
  std::vector<double> fitting_velocities(const Configuration& c) const;
  /// Motions without mass at `c`, or nullptr if the model has none; valid until the next call.
  const MasslessMotions* massless_at(const Configuration& c);
  /// Start::soften() for fixed steps; controlled ones are to find out how short they have to be.
  bool soften(Configuration& c, double h, const MasslessMotions* massless, StartReport* report = nullptr) const;
  /// The same for what controllers follow faster than steps resolve (Start::soften_signals).
  bool soften_signals(Configuration& c, double h) const;
  /// Start::settle_signals() for fixed steps. `c` is `from` after the time `after`.
  bool settle_signals(Configuration& c, const Configuration& from, double after, double h) const;
  /// Gives `c` the multipliers that balance it at its own time.
  void refine_grips(Configuration& c);
  /// Chooses the scales k of the multipliers for steps of h with these weights. Only the order of magnitude of k matters, so
  /// that steps a little shorter than H need no others.
  void scale_for(const Configuration& c, double h, Weights weights);

  Owned<Vec> unknowns_;
  StepError error_;

 private:
  class Inside;
  /// drift_error() between fixed steps.
  double stiff_drift(const Configuration& c, double h);
  /// Changes of motions without mass that balance requires at one instant.
  struct Relaxed {
    std::vector<double> jump;   ///< from springs: displacement to where their forces balance; one entry per motion slot
    std::vector<double> speed;  ///< from dampers: change of the velocity
  };
  /// Moves what has no mass to where its forces balance, with everything else at rest. Velocities and accelerations of `c`
  /// stay. Both results are the components along the massless motions at the new `c`; `massless` becomes these.
  Relaxed relax(Configuration& c, MasslessMotions& massless);
  /// Gives motions without mass positions, velocities and accelerations that balance at the start and a little later.
  void settle(Configuration& c, MasslessMotions& massless, StartReport& report);

  double scaled_for_ = 0;             ///< the h that k was chosen for
  std::optional<bool> has_massless_;  ///< the model has motions without mass; empty: not known yet, after another analysis
  std::optional<MasslessMotions> massless_;
};

}  // namespace engrane::solve
