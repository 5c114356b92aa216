// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "solve/constraints/regularity.hpp"
#include "solve/schemes/scheme.hpp"

namespace engrane::solve {

/// Positions, velocities and accelerations from constraints and drives alone; then the multipliers that this motion requires,
/// including inertia and applied forces. A model with an undriven motion is refused.
class Kinematics final : public Scheme {
 public:
  explicit Kinematics(SolverContext& context);

  StartReport start(Configuration& c) override;
  Outcome attempt(const Configuration& from, double h, Configuration& to) override;
  void accept() override;
  void take_over(Configuration& c) override;
  void save(Snapshot& snapshot) const override;
  void load(const Snapshot& snapshot) override;

 private:
  /// Throws SolutionFailure if a motion is left that no drive determines, according to the last analysis of the constraints.
  void refuse_free_motion(const Configuration& c);
  /// Closes `to`, which must be near, at its time, and fits all else to it; returns the number of position iterations.
  int solve(Configuration& to);
  /// Largest velocities, accelerations and multipliers, lengths over the extent and moments over it.
  struct Sizes {
    double velocity = 0, acceleration = 0, force = 0;

    bool beyond(const Sizes& other, double factor) const {
      return velocity > factor * other.velocity || acceleration > factor * other.acceleration || force > factor * other.force;
    }
  };
  /// `enlarged`: amplification of rounding at `c` (Regularity::amplification), below which no size is told from nothing.
  Sizes sizes(const Configuration& c, double enlarged = 1) const;
  /// Sets `c` to where the motion at `from` leads in a time of `length`: close enough to stay on the same branch of assembly.
  /// Returns the step there.
  std::vector<double> predict(const Configuration& from, double length, Configuration& c) const;
  /// Sets `c` by predict() and solves there; returns the number of position iterations.
  int follow(const Configuration& from, double length, Configuration& c);
  /// Sets `to` to the limit of the motion at a singular position, where the equations do not determine how it goes on: what four
  /// positions before it lead to. `amplification`: that of `from`. Throws SolutionFailure if there is no limit; false, with `to`
  /// unchanged, if there are no such positions.
  bool reach_limit(const Configuration& from, double h, double amplification, Configuration& to, NewtonReport& report);
  /// Whether velocities and accelerations fit the constraints and drives: a drive with a corner on the way to `c` leads
  /// elsewhere.
  bool fits_constraints(const Configuration& c) const;
  /// Whether velocities, accelerations or multipliers of `to` change by a `part` of their size if they are computed once more on
  /// another way, by rounding.
  bool blurred(const Configuration& from, double h, const Configuration& to, double part);
  /// Fails a converged step that ends on the other side of singular positions, unless the motion, followed in shorter and
  /// shorter parts, goes through one. `side`: that before the step.
  void refuse_other_branch(const Configuration& from, double h, const Regularity& side, NewtonReport& report);

  /// Whether velocities and accelerations at two instants can be those of one smooth motion of so short a time: the accelerations
  /// account for the change of the velocities.
  bool fits_together(const Configuration& a, const Configuration& b) const;
  /// follow() in as many parts as are short enough for that, but no shorter than a `part` of the step.
  void follow_closely(const Configuration& from, double length, double part, Configuration& c, NewtonReport& report);
  /// Fails a converged step that is long and does not end where the motion leads, followed closely.
  void refuse_leap(const Configuration& from, double h, const Configuration& to, NewtonReport& report);

  double inertia_ = 0;                   ///< of all masses over the extent, and their moments of inertia
  bool driven_ = false;                  ///< no motion is free: this run has been checked for that, or the one that it continues
  std::optional<Regularity> from_, to_;  ///< at the ends of the last attempt; nothing if unknown
};

}  // namespace engrane::solve
