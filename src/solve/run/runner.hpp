// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "model/jump.hpp"
#include "solve/run/events.hpp"
#include "solve/run/step_control.hpp"

namespace engrane::solve {

/// Report on each accepted step.
struct StepReport {
  int number = 0;        ///< from 1; 0 is the start
  double step = 0;       ///< h
  int cuts = 0;          ///< failed attempts before this one
  bool corner = false;   ///< a function of time has a corner at the end of the step, or equilibria have jumped within it
  bool impulse = false;  ///< the speed of a drive has jumped, and the velocities with it
  bool regular = true;   ///< false: the step ended for an event, not at a multiple of H or after a cut
  bool drift = false;    ///< no step of the scheme: across an event, or over a jump of equilibria
  /// Returns the motion within the step; set with a tolerance only, and within a drift only in models with FineForces.
  std::function<std::unique_ptr<Within>()> within;
  bool settled = false;       ///< frictions came to rest or gave way at its end: forces within belong to the state before
  int locating = 0;           ///< attempts spent on locating an event before this step
  bool chatter = false;       ///< first time that events are too dense to be located
  std::vector<Event> events;  ///< that happened in this step
  const NewtonReport* newton = nullptr;
  bool last = false;               ///< the run is over
  const Course* course = nullptr;  ///< along a path of equilibria
};

/// Called with the start and every accepted step; false ends the run early.
using StepCallback = std::function<bool(const Configuration&, const StepReport&)>;

/// Advances from the start to the end of `.SUB`: cuts steps that fail, lets them grow again, and ends them at events and at
/// multiples of H. With a tolerance steps are controlled by their error, and `after_step` may ask for instants in between.
class Runner {
 public:
  Runner(SolverContext& context, Scheme& scheme);

  /// Starts, and runs to the end; false if `after_step` ended it. Throws SolutionFailure if step cuts do not help.
  bool run(const StepCallback& after_step, const std::function<void(const StartReport&)>& started);
  /// Continues from a snapshot made by save(); `after_step` is called for the steps after it.
  bool resume(const Snapshot& snapshot, const StepCallback& after_step);

  /// Saves the last accepted configuration and everything that later steps depend on. May be called by `after_step`, and after
  /// run() has returned or thrown.
  void save(Snapshot& snapshot) const;
  const Configuration& now() const { return now_; }
  const SolverOptions& options() const { return options_; }
  /// Loads and lengths of the last steps (Scheme::references).
  const References& references() const { return scheme_.references(); }
  /// Number of steps accepted since the run started or was resumed.
  long steps() const { return step_.number - resumed_at_; }
  bool started() const { return started_; }  ///< now() is an accepted configuration

 private:
  using Kind = EventLocator::Finding::Kind;
  /// An attempt of a step from now_ to next_.
  struct Tried {
    double size = 0;
    Outcome outcome;
    EventLocator::Finding found;
    bool jumps = false;  ///< equilibria jump within it

    double error() const { return outcome.error.value_or(0); }
  };
  bool march();
  /// march() with steps that follow their error, and with steps of length H.
  bool march_by_error();
  bool march_evenly();
  /// How a corner of a function of time is met.
  struct WayToCorner {
    double before = 0;  ///< end of the last step before it
    bool jumps = false, impulse = false;
  };
  WayToCorner way_to(double corner) const;
  /// Ends a step at a corner of a function of time and passes it.
  bool meet_corner(double corner);
  bool reach(double target);
  /// Makes one attempt towards `target`, and the step or the drift that it allows; false if `after_step` ended the run.
  bool advance(double target);
  Tried attempt(double left);
  /// Would a drift across an event be too inaccurate before it?
  bool strays(double drift);
  /// Each of these is true if an attempt may be taken as far as it can tell, and otherwise has prepared the next one: a drift may
  /// cross the event; there is a solution, or one where equilibria jump to; its error is allowed; it leaps to no other path.
  bool crosses(const Tried& tried);
  bool solved(Tried& tried, double left);
  bool accurate(Tried& tried);
  bool stays(Tried& tried);
  /// Accepts an attempt, and drifts across the event that it ends before; false if `after_step` ended the run.
  bool take(const Tried& tried, double target);
  /// Passes a corner of a function of time from `before`, which is the corner itself where nothing jumps.
  bool pass_corner(double before, double corner, bool impulse);
  /// Speeds of drives and supports in the motion up to now_, with which what follows has to fit.
  std::vector<ValueAndRate> speeds_so_far() const;
  /// Advances along the scheme's own path (Scheme::course()).
  bool follow();
  bool over() const;
  /// Analyses the constraints again after a failed attempt; true if that changes them.
  bool renew(const NewtonReport& report);
  bool drift(double time, double target);
  /// The part of a drift that lies before the event, under the present force law; 0: too short to be divided.
  double before_event(double drift) const;
  bool drifts(double way);
  /// Processes a newly accepted now_: of a step (`solved`), whose beginning is next_, or of a drift.
  bool accepted(double size, bool regular, bool solved);
  /// Length of an attempt towards a point `left` ahead: equal parts of it, as long as h_ allows.
  double next_size(double left) const;
  /// Would a step `shorter` than one of `size` be shorter than CUTS allows?
  bool shortest(double size, double shorter) const;
  /// Do equilibria jump within a load step whose error is too large and that would be cut to `shorter`, or is no step that
  /// CUTS allows short enough to decide?
  bool jumps_at(double size, double shorter, double error);
  /// Where equilibria near now_ have come to an end, as at a limit load, and no shorter step finds one: seeks next_ where the
  /// structure would snap to, and by Newton's iteration, with steps longer than `size`, to the next multiple of H at most.
  /// Returns the length of the one that `outcome` is then of, or 0.
  double find_beyond(double size, double left, Outcome& outcome);
  /// now_ is the end of such a jump: what lies before it says nothing about what follows.
  void pass_jump();
  /// Prepares the next attempt, with `shorter`, after a failed one of `size`; throws after too many cuts.
  void cut(double size, double shorter, const NewtonReport& report);

  SolverContext& context_;
  Scheme& scheme_;
  const SolverOptions& options_;
  EventLocator locator_;
  StepControl control_;
  const StepCallback* after_step_ = nullptr;
  Configuration now_, next_;
  std::optional<Configuration> unsettled_;  ///< now_ before frictions came to rest or gave way there
  std::vector<double> ended_;               ///< scalars of now_ before whole turns were counted
  double h_;
  bool started_ = false;
  int resumed_at_ = 0;                        ///< number of the step after which the run was resumed
  std::vector<ValueAndRate> earlier_speeds_;  ///< speeds_so_far() when resumed; empty later
  bool renewed_ = false;                      ///< constraints have been analysed again on the way to the present target
  std::optional<double> corner_;              ///< corner of a function of time that is being approached
  bool beside_even_ = false;                  ///< now_ is, or leads to, a corner between the ends of even steps
  std::optional<double> jumped_at_;           ///< end of the last jump of equilibria
  bool within_drifts_;                        ///< the motion within drifts is needed
  Configuration before_drift_;                ///< in this case, where the last one began
  double pending_drift_ = 0;                  ///< time to drift across the event just before which the last step ended
  StepReport step_;
};

}  // namespace engrane::solve
