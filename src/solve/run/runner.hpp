// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "solve/run/events.hpp"
#include "solve/run/step_control.hpp"

namespace engrane::solve {

/// What the run tells about each accepted step.
struct StepReport {
  int number = 0;       ///< from 1; 0 is the start
  double step = 0;      ///< h
  int cuts = 0;         ///< failed attempts before this one
  bool corner = false;  ///< a function of time has a corner at the end of the step
  bool regular = true;  ///< false: the step ended for an event, not where a multiple of H or a cut asks for it
  /// Gives the motion within the step; only with a tolerance, and empty where the step is but a drift across an event.
  std::function<std::unique_ptr<Within>()> within;
  int locating = 0;           ///< attempts spent on locating an event before this step
  bool chatter = false;       ///< the first time that events come too thick to be located
  std::vector<Event> events;  ///< that happened in this step
  const NewtonReport* newton = nullptr;
  bool last = false;               ///< the run is over
  const Course* course = nullptr;  ///< along a path of equilibria
};

/// Called with the start and every accepted step; false ends the run early.
using Observer = std::function<bool(const Configuration&, const StepReport&)>;

/// Goes from the start to the end of `.SUB`: cuts steps that fail, lets them grow again, ends them at events and at the
/// multiples of H. Where a tolerance is asked for, steps follow their errors, and who observes may ask for instants between.
class Runner {
 public:
  Runner(SolverContext& context, Scheme& scheme);

  /// Starts, and runs to the end. Throws SolutionFailure when cutting does not help; false when the observer ended it.
  bool run(const Observer& observer, const std::function<void(const StartReport&)>& started);
  /// Goes on from a snapshot that save() made; the observer sees the steps after it.
  bool resume(const Snapshot& snapshot, const Observer& observer);

  /// The last accepted configuration and everything that the steps after it depend on. May be called by the observer, and
  /// after run() has returned or thrown.
  void save(Snapshot& snapshot) const;
  const Configuration& now() const { return now_; }
  const SolverOptions& options() const { return options_; }
  /// Accepted since it started or was resumed.
  long steps() const { return step_.number - resumed_at_; }
  bool started() const { return started_; }  ///< now() is an accepted configuration

 private:
  bool march();
  bool reach(double target);
  /// Along the scheme's own course.
  bool follow();
  bool over() const;
  /// Looks at the constraints again after an attempt that failed; true where that changes them.
  bool renew(const NewtonReport& report);
  bool drift(double time, double target);
  /// Of a drift over an event the part before it, under the law that has held so far; 0: all is too short to be divided.
  double before_event(double drift) const;
  /// now_ is accepted: by a step that was `solved`, which next_ began, or by a drift.
  bool accepted(double size, bool regular, bool solved);
  /// The step that an attempt towards a point `left` ahead takes: equal parts of it, as long as h_ allows.
  double next_size(double left) const;
  /// Prepares the next attempt, of `shorter`, after one of `size` that failed; throws when there have been too many.
  void cut(double size, double shorter, const NewtonReport& report);

  SolverContext& context_;
  Scheme& scheme_;
  const SolverOptions& options_;
  EventLocator locator_;
  StepControl control_;
  const Observer* observer_ = nullptr;
  Configuration now_, next_;
  std::vector<double> ended_;  ///< scalars of now_ before whole turns were counted
  double h_;
  bool started_ = false;
  int resumed_at_ = 0;            ///< number of the step after which it was
  bool renewed_ = false;          ///< constraints have been analysed anew on the way to the present target
  std::optional<double> corner_;  ///< of a function of time, that is being approached
  double pending_drift_ = 0;      ///< time to drift over the event that the last step has landed before
  StepReport step_;
};

}  // namespace engrane::solve
