// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "solve/schemes/scheme.hpp"

namespace engrane::solve {

/// Positions, velocities and accelerations from constraints and drives alone; then the multipliers that this motion requires,
/// including inertia and applied forces. A model with an undriven motion is refused.
class Kinematics final : public Scheme {
 public:
  explicit Kinematics(SolverContext& context) : Scheme(context) {}

  StartReport start(Configuration& c) override;
  Outcome attempt(const Configuration& from, double h, Configuration& to) override;
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
  Sizes sizes(const Configuration& c) const;

  bool driven_ = false;  ///< no motion is free: this run has been checked for that, or the one that it continues
};

}  // namespace engrane::solve
