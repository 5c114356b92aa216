// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "solve/schemes/solver_context.hpp"

namespace engrane::solve {

/// Watches the iterations of statics for steps that begin in a singular position: where constraints lose their rank, as with
/// bars in line, the first correction leads to either of two assembly branches, as rounding decides. The displacements of the
/// step before stay on its branch.
class BranchWatch {
 public:
  /// Not `wanted` for linear models, nor where steps begin on the path of the equilibria before, which stays on its branch.
  BranchWatch(SolverContext& context, bool wanted);

  /// Call before each iteration.
  void begin();
  /// Call for each configuration that the iteration comes to.
  void look();
  /// Call after the iteration of a step of h.
  void tried(double h) { tried_h_ = h; }
  /// Whether this step began in a singular position, and the one before it did not.
  bool doubts() const;
  /// The displacements of the step before, over the length of a step of h, by motion slot; for steps that doubts() calls in
  /// question.
  std::vector<double> continued(double h) const;
  /// Call when the step in question has been solved again: its first tangent tells nothing.
  void disregard() { response_ = last_response_; }
  /// Takes over the displacements of the step tried last.
  void accept(const std::vector<double>& displacements);

  void save(Snapshot& snapshot) const;
  void load(const Snapshot& snapshot);

 private:
  SolverContext& context_;
  bool active_;
  int configurations_ = 0;  ///< of the present iteration
  /// Size of the solution for the probe (fill_loads()) at the beginning of the step tried last, and of the last accepted step; 0:
  /// unknown.
  double response_ = 0, last_response_ = 0;
  std::vector<double> last_displacements_;  ///< of the last accepted step, of length last_h_; empty before the first
  double tried_h_ = 0, last_h_ = 0;
};

}  // namespace engrane::solve
