// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/snapshot.hpp"
#include "model/solver_options.hpp"

namespace engrane::solve {

/// Chooses steps from the errors of those before, by predictive control (Gustafsson 1994). Steps stay as they are
/// where they would change little: factors and what a scheme remembers belong to one step.
class StepControl {
 public:
  /// `order`: the power of the step that errors grow with.
  StepControl(const SolverOptions& options, int order);

  bool active() const { return active_; }
  double longest() const { return longest_; }
  /// The step after one of `size` that stands, with its error over the tolerance; `asked` is what it would have been but for an
  /// event or the end of the run.
  double after(double size, double error, double asked);
  /// What to try after a step of `size` with too large an error.
  double retry(double size, double error);
  /// A step has been refused for another reason.
  void refused() { refused_ = true; }

  void save(Snapshot& snapshot) const;
  void load(const Snapshot& snapshot);

 private:
  bool active_;
  double longest_, order_;
  double error_before_ = 1, size_before_ = 0;  ///< of the last step that stood; 0: none has
  bool refused_ = false;                       ///< since then an attempt was: no growth
};

}  // namespace engrane::solve
