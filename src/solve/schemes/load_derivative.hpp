// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "solve/schemes/solver_context.hpp"

namespace engrane::solve {

/// Change of the scaled residual with the loads' time, prescribed displacements moved along, everything else at rest; into `f`.
/// Differences of second order towards one side, the sign of `step`: a function of time may have a corner where the equilibrium
/// is. Exact where functions are linear or quadratic. Collective.
class LoadDerivative {
 public:
  LoadDerivative(SolverContext& context, double step);

  void find(const Configuration& c, Vec f);
  /// Looks ahead, or back.
  void turn(bool ahead) { step_ = ahead ? std::abs(step_) : -std::abs(step_); }

 private:
  SolverContext& context_;
  double step_;
  Owned<Vec> next_;
  Configuration moved_;
};

/// The configuration with every motion slot moved by y, as a place of its own that tangents are symmetric at: the increments of
/// rotations begin anew there.
void move_and_rest(const SolverContext& context, const Configuration& from, std::span<const double> y, Configuration& to);

}  // namespace engrane::solve
