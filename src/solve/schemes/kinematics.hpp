// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "solve/schemes/scheme.hpp"

namespace engrane::solve {

/// Positions, velocities and accelerations from constraints and drives alone; then the multipliers that this motion
/// needs, inertia and applied forces included. What the drives leave free follows with least movement.
class Kinematics final : public Scheme {
 public:
  explicit Kinematics(SolverContext& context) : Scheme(context) {}

  StartReport start(Configuration& c) override;
  Outcome attempt(const Configuration& from, double h, Configuration& to) override;
};

}  // namespace engrane::solve
