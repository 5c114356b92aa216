// SPDX-License-Identifier: BSD-3-Clause
// Events: the instants at which a switch of an element changes sign (docs/theory.md, Events).
#pragma once

#include <optional>
#include <vector>

#include "solve/schemes/scheme.hpp"

namespace engrane::solve {

/// A switch of an element that has changed sign.
struct Event {
  int part = 0;   ///< index into Model::parts
  int index = 0;  ///< into Layout::switches
  bool rises = true;
};

/// The switches of all elements and their sides. Every rank holds the whole configuration and computes the same.
class Switches {
 public:
  Switches(SolverContext& context, const Scheme& scheme);

  /// Whether no step ends for any of them.
  bool empty() const { return empty_; }
  std::vector<Switch> at(const Configuration& c) const;
  /// Switches at the beginning of a step: as a rule with the values of the last take().
  std::vector<Switch> before(const Configuration& c) const;

  /// Takes the sides of an accepted configuration and returns the switches that have changed. A value at rounding level keeps
  /// its side.
  std::vector<Event> take(const Configuration& c);

  /// Takes the sides that are not known yet, as in a run that continues one in which these switches had no meaning.
  void complete_sides(const Configuration& c);

  /// Determines the sides of the grips anew, whose meaning changes when friction comes to rest or gives way; after take() at
  /// the same time. Returns the changes that take() left open: friction has changed where a switch was at rounding level.
  std::vector<Event> renew(const Configuration& c);

  /// Sides: 1, −1, or 0 for a switch that has no meaning at present.
  const std::vector<int>& sides() const { return side_; }

  void save(Snapshot& snapshot) const;
  void load(const Snapshot& snapshot);

  /// Time from `from`, which is h before `to`, to the first change of a side, by the cubic with the values and rates at both
  /// ends, so that a phase that begins and ends within the step is found.
  std::optional<double> first_change(const std::vector<Switch>& from, const std::vector<Switch>& to, double h) const;
  /// Time from `to` to the first change after it, within `ahead`, by extrapolating the same cubics.
  std::optional<double> next_change(const std::vector<Switch>& from, const std::vector<Switch>& to, double h, double ahead) const;
  /// Replaces unknown rates (NaN) at both ends, h apart, by the slope of the chord.
  static void complete(std::vector<Switch>& from, std::vector<Switch>& to, double h);
  /// Time to the next change of a side, as predicted by values and rates; infinite if none is near. A value that stays within
  /// rounding of zero for longer than `tolerance` rests there: its side changes when it leaves.
  double time_to_change(const std::vector<Switch>& now, double tolerance) const;
  /// Longest time that switches about to change within `ahead` take to pass through their rounding: no event can be located
  /// more sharply.
  double blur(const std::vector<Switch>& now, double ahead) const;

 private:
  SolverContext& context_;
  const Scheme& scheme_;
  struct Place {
    int part, index;
    bool active;
    int equation;    ///< of the multiplier that is its value; −1: none is
    int multiplier;  ///< its place among all
  };
  std::vector<Place> places_;
  bool empty_ = true;
  std::vector<int> side_;      ///< 1, −1 or 0
  std::vector<Switch> taken_;  ///< values at the last take()
  double taken_at_ = 0;
};

/// First t in [0, h] at which the cubic with values a, b and rates da, db at 0 and h falls below −`band`, if there is one.
std::optional<double> first_descent(double a, double da, double b, double db, double h, double band);

/// Ends steps at events. An event is met by a step that ends a little before it and a drift across it. Steps are never shorter
/// than `shortest()`, below which the inverse square of the step amplifies rounding; a drift takes their place. Controlled
/// steps may end as far before an event as a drift is more accurate than they are.
class EventLocator {
 public:
  EventLocator(SolverContext& context, Scheme& scheme);

  bool active() const { return active_; }
  double shortest() const { return 0.01 * step_; }
  /// Largest time from the end of a step to the event that it is to meet.
  double tolerance() const { return tolerance_; }

  /// Sets the present length of steps.
  void step_is(double step);

  Switches& switches() { return switches_; }
  /// Resets the guard against chattering: steps aim at a new multiple of H, or a controlled step has met no event.
  void new_target() { located_ = 0; }

  struct Finding {
    enum class Kind {
      none,   ///< no event in the step just tried
      land,   ///< `to` ends a little before the event; then drift
      drift,  ///< the event is too near for a step: drift at once
      pass,   ///< the step passes over the event
      failed  ///< an attempt did not converge
    } kind = Kind::none;
    double step = 0;   ///< of the last attempt
    double drift = 0;  ///< time to drift across the event
    int attempts = 0;  ///< beyond the first
    std::optional<Outcome> outcome;
  };
  /// Returns the length to try for a controlled step of at most `size`: just short of the first event that is predicted by the
  /// last step.
  double foresee(const Configuration& from, double size);
  /// A step of `size` has been accepted: the switches at its beginning help to predict the next event.
  void stepped(double size) {
    before_ = began_;
    last_step_ = size;
    ++made_;
  }
  /// An event has been crossed.
  void forget() {
    last_step_ = 0;
    made_ = 0;
  }
  /// Examines an attempt of `size` from `from` to `to`, converged or not.
  Finding inspect(const Configuration& from, double size, bool converged, Configuration& to);

  /// The sides, and how many events were located on the way to the present multiple of H, for a restart.
  void save(Snapshot& snapshot) const;
  void load(const Snapshot& snapshot);

  /// Whether the guard has switched off location for the rest of the step; true once per run.
  bool chatters();

 private:
  /// Search for the first event behind `from`.
  struct Search {
    const Configuration& from;
    Configuration& to;     ///< end of the last attempt
    double free, past;     ///< no change up to `free`; one before `past`, or no solution there
    double event = 0;      ///< predicted time of the change
    double ahead = 0;      ///< time from `to` to the next change
    int failures = 0;      ///< attempts without a solution
    bool coasted = false;  ///< the motion at `from` shows no event that would be too near for a step
  };
  /// Time of the first change within an attempt of h; sets `ahead`. A step that ends within rounding of an event may have used
  /// either law at its end, and counts as past it.
  std::optional<double> change_within(Search& search, double h);
  /// Whether an event is to be located because of an attempt of `size` that converged. If not, it may be the step that was to end
  /// before one (`found`).
  bool sees_event(Search& search, double size, Finding& found);
  /// The same because of one that did not converge.
  bool suspects_event(Search& search, double size) const;
  /// Whether an event too near for a step is to be crossed at once; otherwise the shortest step is tried.
  bool drifts_at_once(Search& search, Finding& found) const;
  /// Length of the next attempt; `free` if it is the last.
  double next_size(const Search& search, int attempts) const;
  /// Makes attempts until one shows how the event is met.
  void locate(Search& search, Finding& found);
  /// One more event on the way to the present multiple of H.
  void note_event();
  /// Time to the first event within `size`, predicted by velocities and accelerations of `from`; `now`: the switches there.
  std::optional<double> coasting_change(const Configuration& from, std::vector<Switch> now, double size) const;
  /// How far before an event a step of `size` may end.
  double reach(double size) const;
  /// Sets how sharply events within `ahead` of these values are located.
  void sharpen(const std::vector<Switch>& now, double ahead);

  Scheme& scheme_;
  Switches switches_;
  double step_, sharpness_, tolerance_ = 0;
  double part_of_drift_ = 0;  ///< largest drift, over a controlled step
  bool active_ = false;
  std::vector<Switch> began_;   ///< at the beginning of the last attempt
  std::vector<Switch> before_;  ///< at the beginning of the last accepted step
  double last_step_ = 0;        ///< from there to the beginning of the next; 0: unknown
  int made_ = 0, least_ = 1;    ///< controlled steps made since the last event, and least number between two
  double aimed_ = 0;            ///< time within which an event was predicted that the present attempt is to end near; 0: none
  int located_ = 0;
  bool chattered_ = false, told_ = false;
};

}  // namespace engrane::solve
