// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "solve/schemes/solver_context.hpp"

namespace engrane::solve {

/// Derivative of the scaled residual with respect to the load time, with prescribed displacements moved along and everything
/// else at rest; find() writes it into `f`. Differences are of second order and one-sided, to the side of the sign of `step`: a
/// function of time may have a corner at the equilibrium. Exact where functions are linear or quadratic. Collective.
class LoadDerivative {
 public:
  LoadDerivative(SolverContext& context, double step);

  void find(const Configuration& c, Vec f);
  /// Writes the change of the residual to a load time that is `later` by so much into `f`.
  void change(const Configuration& c, double later, Vec f);
  /// Makes differences look ahead, or back.
  void turn(bool ahead) { step_ = ahead ? std::abs(step_) : -std::abs(step_); }

 private:
  void residual(const Configuration& c, double later, Vec into);

  SolverContext& context_;
  double step_;
  Owned<Vec> next_;
  Configuration moved_;
};

}  // namespace engrane::solve
