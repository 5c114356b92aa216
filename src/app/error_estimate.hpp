// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/solver_options.hpp"

namespace engrane::app {

/// Error estimate of a run, from its difference to its companion. Times are processor times in seconds.
struct ErrorEstimate {
  double error = 0;     ///< the largest of all channels asked for: root of the mean square over time, over the channel's range
  std::string channel;  ///< the one with this error
  double share = 1;     ///< fraction of the difference between the run and its companion that is taken as the error
  bool falls = true;    ///< the difference falls with TOL; if not, all of it is taken as the error
  double tolerance = 0, companion_tolerance = 0;  ///< TOL of the run and of its companion
  double seconds = 0, companion_seconds = 0;
  double earlier_seconds = 0;  ///< of all runs before the companion
  double vibration = 0;        ///< period (time) of a vibration that steps have lost, if `error` is what is missing of it; else 0
  double ratio_of_steps = 1;   ///< number of steps of the run over that of its companion
  double order = 1;            ///< power of TOL to which errors are proportional, where steps follow TOL
  double order_of_steps = 1;   ///< power of the step length to which errors are proportional
  double longest = 0;    ///< length of the steps (time) if all are as long as HMAX allows, so that TOL has no effect; else 0
  double shortened = 0;  ///< longest step (time) if earlier runs reduced the HMAX of the deck; else 0
  bool begins_looser = false;   ///< runs with this scheme begin with AccuracyRung::first
  std::optional<double> since;  ///< time of the restart point of both runs; the error before it is not in the estimate
  std::string trouble;          ///< why there is no estimate

  /// Difference of the two runs, in the same measure as `error`.
  double difference() const { return error / share; }
  /// Compares with the differences of earlier pairs of runs with larger TOL, the first one first: sets `falls`. In chaos they
  /// are about the same; where runs begin to resolve a vibration they grow before they fall.
  void follow(const std::vector<double>& differences);
  /// Takes an error for this one that the difference of the two runs does not show, if it is larger: `error` of `where`, by the
  /// loss of a vibration with this period. If it exceeds the `target`, it also explains differences that do not fall with TOL.
  /// What comes of the difference alone is to be asked for before.
  void include_lost(double lost, const std::string& where, double period, double target);
  /// Call if all steps of the run have this length, the longest allowed, and those of the companion twice that: motions that are
  /// faster are not seen.
  void steps_reach(double longest_step);
  /// Length of steps that follow the vibration that is lost.
  double follows_vibration() const;
  /// Length of steps that is expected to give half of an error `target`. `differences`: as for follow().
  double longest_for(double target, const std::vector<double>& differences) const;
  /// Error and processor time that another tolerance is expected to have.
  double error_at(double other) const;
  double seconds_at(double other) const;
  /// Tolerance that is expected to give half of an error `target`.
  double tolerance_for(double target) const;
  /// Tolerance with which a run of another setting would end: runs that miss its target are repeated (Attempt::sharper()).
  double tolerance_of(const AccuracyRung& rung) const;
  /// States an error larger than the `target`.
  std::string miss(double target) const;
  /// A warning if there is no estimate, or if it exceeds the `target`; otherwise empty. `sharper_failed`: why the run was not
  /// repeated with a smaller tolerance; empty if that may help.
  std::string warning(double target, const std::string& sharper_failed) const;
  /// Text for the listing. `target`: the error asked for.
  std::string describe(double target) const;
};

}  // namespace engrane::app
