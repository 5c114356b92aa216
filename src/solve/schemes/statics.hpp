// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "solve/schemes/scheme.hpp"

namespace engrane::solve {

/// Equilibrium without inertia and damping, time being only the parameter of loads and drives.
class Statics final : public Scheme {
 public:
  explicit Statics(SolverContext& context);

  StartReport start(Configuration& c) override;
  Outcome attempt(const Configuration& from, double h, Configuration& to) override;

 private:
  /// Newton's iteration from the displacements `y` and the multipliers of `to`, which end as the solution.
  NewtonReport balance(const Configuration& from, std::span<double> y, Configuration& to);
  /// Flanks across a gap give no stiffness to find each other by: contacts begin as springs that fade away.
  NewtonReport balance_across_gaps(const Configuration& from, std::span<const double> y, Configuration& to);

  bool has_contacts_;
  Owned<Vec> unknowns_;
};

}  // namespace engrane::solve
