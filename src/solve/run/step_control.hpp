// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <vector>

#include "base/snapshot.hpp"
#include "model/solver_options.hpp"

namespace engrane::solve {

/// Chooses step lengths from the errors of earlier steps, by predictive control (Gustafsson 1994). Steps that would change
/// little are kept, since factors and the memory of a scheme belong to one length.
class StepControl {
 public:
  /// Whether a step ended before an event: where it was predicted, or after attempts that went too far.
  enum class Landing { none, foreseen, sought };
  /// `order`: power of the step with which errors grow.
  StepControl(const SolverOptions& options, int order);

  bool active() const { return active_; }
  double longest() const { return longest_; }
  /// Returns the length of the step after an accepted one of `size`, with its error over the tolerance. `asked`: what the
  /// length would have been but for an event or the end of the run.
  double after(double size, double error, double asked, Landing landing = Landing::none);
  /// Returns the length to try after a step of `size` with too large an error.
  double retry(double size, double error);
  /// To be called for an attempt from `begin` with too large an error, before retry(): whether the error is the same as that of
  /// attempts which were a hundred times longer. What the steps are to follow then jumps there, and shorter ones do not help.
  bool stays(double begin, double size, double error);
  /// Discards what is known of earlier steps.
  void begin_anew();
  /// A step has been rejected for another reason.
  void refused() { refused_ = true; }
  /// An event has led to other `sides` of the switches: returns the step to begin with there, learnt from the first steps there
  /// on earlier occasions; `asked` the first time.
  double enter(const std::vector<int>& sides, double asked);

  void save(Snapshot& snapshot) const;
  void load(const Snapshot& snapshot, std::size_t sides);  ///< `sides`: number of switches

 private:
  struct Attempt {
    double end, size, error;
  };
  double next(double size, double error, double asked);
  /// Learns from the first step after an event, of `size`, for later ones there; `step`: the proposed next one.
  void remember(double size, double step, Landing landing);

  bool active_;
  double longest_, order_;
  double error_before_ = 1, size_before_ = 0;  ///< of the last accepted step; 0: none yet
  bool refused_ = false;                       ///< an attempt was rejected since then: no growth
  std::vector<Attempt> inaccurate_;            ///< those noted by stays() that reach beyond the last accepted step
  std::map<std::vector<int>, double> steps_;   ///< first steps after events, by the sides there
  std::vector<int> entered_;                   ///< sides with which no step has been made yet
};

}  // namespace engrane::solve
