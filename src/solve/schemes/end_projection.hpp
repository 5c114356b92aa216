// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "assembly/configuration.hpp"
#include "base/snapshot.hpp"
#include "solve/algebra/linear.hpp"
#include "solve/constraints/massless.hpp"
#include "solve/schemes/solver_context.hpp"

namespace engrane::solve {

/// Gives the end of a step velocities, accelerations and multipliers that fit its positions (Jay 1995). The velocities satisfy
/// the constraints by the least change in the metric of the masses; accelerations and multipliers are those of balance. Both use
/// the matrix of Assembler::projection.
class EndProjection {
 public:
  /// `keeps`: the matrix is kept from step to step, as long as the iteration converges fast with it.
  EndProjection(SolverContext& context, bool keeps);

  /// Prepares for fits at `c`, with the matrix of an earlier configuration if there is one.
  void begin(const Configuration& c);
  /// Evaluates the matrix at `c`.
  void renew(const Configuration& c);
  /// Fit to the positions of `c` (and the accelerations to its velocities); false if they are not determined.
  bool fit_velocities(Configuration& c);
  bool fit_accelerations(Configuration& c, const MasslessMotions* massless);
  /// Takes out of `rates` (by motion slot) what the constraints where the matrix was evaluated do not admit, by the least change
  /// in the metric of the masses; false if singular.
  bool leave_admissible(std::vector<double>& rates);

  /// State of the linear solver, for a restart.
  void save(Snapshot& snapshot) const;
  void load(const Snapshot& snapshot);

 private:
  /// Relative size below which velocities and accelerations need no further correction.
  double least_correction() const;
  /// Whether a correction of velocities or accelerations (by motion slot) exceeds least_correction() of the largest of `rates`,
  /// over the length of the model or in radians.
  bool worth(std::span<const double> change, std::span<const double> rates) const;
  /// Finds the change of the motion (by slot) and of multipliers (by equation) for right_side_; false if singular.
  bool solve(std::vector<double>& change, std::span<const double>& found);

  SolverContext& context_;
  bool keeps_;
  bool has_friction_ = false;
  Owned<Mat> matrix_;
  LinearSolver solver_;
  bool kept_ = false;               ///< the matrix may be reused
  bool fits_ = false;               ///< and was evaluated at this very configuration
  std::vector<double> right_side_;  ///< by equation
  Owned<Vec> right_, solution_;
};

}  // namespace engrane::solve
