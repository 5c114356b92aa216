// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "solve/schemes/scheme.hpp"
#include "solve/schemes/step_error.hpp"

namespace engrane::solve {

/// What the schemes of dynamics have in common: the start, what has no mass, events, and frictions that come to rest. A scheme
/// adds its steps, and its memory of earlier ones.
class Dynamics : public Scheme {
 public:
  explicit Dynamics(SolverContext& context);

  StartReport start(Configuration& c) override;
  bool meets_events() const override { return true; }
  Configuration coast(const Configuration& c, double h) const override { return glide(c, h); }
  void drift(Configuration& c, double h) override;
  double drift_error(const Configuration& c, double h) override;
  bool settle_friction(Configuration& c) override;
  void take_over(Configuration& c) override;
  std::unique_ptr<Within> within(const Configuration& from, const Configuration& to, std::span<const double> scalars) override;
  void save(Snapshot& snapshot) const override;
  void load(const Snapshot& snapshot) override;

 protected:
  /// Within::balance().
  virtual bool restore_balance(Configuration& /*c*/) { return false; }

  /// Starts the scheme's memory from `c`, a solution at the start of the run. `softened`: its accelerations are (Start::soften).
  virtual void start_memory(const Configuration& c, const MasslessMotions* massless, bool softened) = 0;
  /// The same after an event, with which forces may begin; may change accelerations of `c` as soften() does.
  virtual void restart_memory(Configuration& c) = 0;

  /// `c` moved by h with the accelerations it has; these and the multipliers do not change.
  Configuration glide(const Configuration& c, double h) const;
  /// Are changes of `rates` more than rounding: times `scale` displacements larger than that of places, or larger than a `share`
  /// of the largest of the rates themselves?
  bool counts(std::span<const double> changes, double scale, std::span<const double> rates, double share) const;
  bool constrained() const;
  /// The velocities of `c` changed, in kinetic energy as little as possible, until they fit its constraints; the same where that
  /// is rounding, or where none fit.
  std::vector<double> fitting_velocities(const Configuration& c) const;
  /// The motions without mass at `c`, or nullptr where the model has none; valid until the next call.
  const MasslessMotions* massless_at(const Configuration& c);
  /// Start::soften() for steps that follow no tolerance: others are to find out how short they have to be.
  bool soften(Configuration& c, double h, const MasslessMotions* massless, StartReport* report = nullptr) const;
  /// Gives `c` the multipliers that balance it at its own instant.
  void refine_grips(Configuration& c);
  /// Chooses the scales k of the multipliers for steps of h with these weights. Only the order of magnitude of k matters: steps
  /// of a little less than H need no other.
  void scale_for(const Configuration& c, double h, Weights weights);

  Owned<Vec> unknowns_;
  StepError error_;

 private:
  class Inside;
  /// drift_error() between fixed steps.
  double stiff_drift(const Configuration& c, double h);
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

  double scaled_for_ = 0;             ///< the h that k was chosen for
  std::optional<bool> has_massless_;  ///< the model has motions without mass; nobody has looked yet after another analysis
  std::optional<MasslessMotions> massless_;
};

}  // namespace engrane::solve
