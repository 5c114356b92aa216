// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <vector>

#include "base/snapshot.hpp"
#include "model/solver_options.hpp"

namespace engrane::solve {

/// Chooses steps from the errors of those before, by predictive control (Gustafsson 1994). Steps stay as they are
/// where they would change little: factors and what a scheme remembers belong to one step.
class StepControl {
 public:
  /// Whether a step ends before an event: at once where it was expected, or after attempts that went too far.
  enum class Landing { none, foreseen, sought };
  /// `order`: the power of the step that errors grow with.
  StepControl(const SolverOptions& options, int order);

  bool active() const { return active_; }
  double longest() const { return longest_; }
  /// The step after one of `size` that stands, with its error over the tolerance; `asked` is what it would have been but for an
  /// event or the end of the run.
  double after(double size, double error, double asked, Landing landing = Landing::none);
  /// What to try after a step of `size` with too large an error.
  double retry(double size, double error);
  /// A step has been refused for another reason.
  void refused() { refused_ = true; }
  /// An event has led to other `sides` of the switches: the step to begin with there. It is what the first step there has told
  /// the last times; `asked` the first time.
  double enter(const std::vector<int>& sides, double asked);

  void save(Snapshot& snapshot) const;
  void load(const Snapshot& snapshot, std::size_t sides);  ///< of so many switches

 private:
  double next(double size, double error, double asked);
  /// What the first step behind an event, of `size`, tells of those that will be made there; `step` would be the next one.
  void remember(double size, double step, Landing landing);

  bool active_;
  double longest_, order_;
  double error_before_ = 1, size_before_ = 0;  ///< of the last step that stood; 0: none has
  bool refused_ = false;                       ///< since then an attempt was: no growth
  std::map<std::vector<int>, double> steps_;   ///< behind events, by the sides there
  std::vector<int> entered_;                   ///< sides that no step has been made with yet
};

}  // namespace engrane::solve
