// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "observe/observer.hpp"
#include "solve/run/runner.hpp"
#include "solve/schemes/solver_context.hpp"

namespace engrane::app {

/// The power of drives and supports jumps where the acceleration that they impose does. Fixed steps of RADAU that end there have
/// the accelerations that follow: for the work of the step, accelerations and forces are found again as they were before.
/// (Accelerations and forces of the generalised-α schemes are those of the step.)
class CornerPowers {
 public:
  /// Both must outlive this object.
  CornerPowers(solve::SolverContext& context, observe::Observer& observer);

  /// Makes the observer integrate up to the corner at the end of an accepted step, if there is one, before the end itself is
  /// observed. Collective.
  void observe(const Configuration& end, const solve::StepReport& step) const;

 private:
  solve::SolverContext& context_;
  observe::Observer& observer_;
  std::vector<double> corners_;
};

}  // namespace engrane::app
