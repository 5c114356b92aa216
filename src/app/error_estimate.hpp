// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/solver_options.hpp"

namespace engrane::app {

/// What the results are estimated to be off by.
struct ErrorEstimate {
  double error = 0;     ///< the largest of all channels asked for: root of the mean square over time, over the channel's range
  std::string channel;  ///< that has it
  double share = 1;     ///< of the difference between the run and its companion, which is taken as the error
  bool falls = true;    ///< smaller TOL make the difference smaller; else all of it is the error
  double tolerance = 0, companion_tolerance = 0;  ///< TOL of the run and of its companion
  double seconds = 0, companion_seconds = 0;
  double earlier_seconds = 0;   ///< of runs before the companion
  double ratio_of_steps = 1;    ///< how many times the companion's the run has
  double order = 1;             ///< the power of TOL that errors go with, as far as steps follow it
  double order_of_steps = 1;    ///< the power of the steps that errors go with
  double longest = 0;           ///< the steps' length, where all are as long as they may be, so that TOL does not matter; else 0
  double shortened = 0;         ///< the longest step, where earlier runs made it shorter than the deck does; else 0
  bool begins_looser = false;   ///< runs of its kind begin with AccuracyRung::first
  std::optional<double> since;  ///< where both runs went on from an earlier one, of which the estimate knows nothing
  std::string trouble;          ///< why there is no estimate

  /// What the two runs differ by, as `error`.
  double difference() const { return error / share; }
  /// Compares with the differences of earlier pairs of runs with larger TOL, the first one first: sets `falls`.
  void follow(const std::vector<double>& differences);
  /// All steps of both runs are as long as they may be, of this length or twice that: they pass over what is shorter.
  void steps_reach(double longest_step);
  /// A length of steps that is expected to give half of an error. `differences`: as for follow().
  double longest_for(double target, const std::vector<double>& differences) const;
  /// Error and processor time that another tolerance is expected to have.
  double error_at(double other) const;
  double seconds_at(double other) const;
  /// A tolerance that is expected to give half of an error.
  double tolerance_for(double target) const;
  /// The one that another setting would end with: runs that miss its target are made again (Attempt::sharper()).
  double tolerance_of(const AccuracyRung& rung) const;
  /// Where there is no estimate, or it is more than the `target`; empty otherwise. `sharper_failed`: why the run was not made
  /// again with a smaller tolerance; empty if that may help.
  std::string warning(double target, const std::string& sharper_failed) const;
  /// For the listing, beside the `target` that was asked for.
  std::string describe(double target) const;
};

}  // namespace engrane::app
