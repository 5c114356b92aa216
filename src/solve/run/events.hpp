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

/// The switches of all elements, and the side that each is on. Every rank computes the same, for every rank holds the whole
/// configuration.
class Switches {
 public:
  explicit Switches(SolverContext& context);

  bool empty() const { return places_.empty(); }
  std::vector<Switch> at(const Configuration& c) const;
  /// The same for a configuration that a step begins in: as a rule that which take() has seen last.
  std::vector<Switch> before(const Configuration& c) const;

  /// Takes the sides of an accepted configuration and returns the switches that have changed. A value that is mere rounding
  /// stays on the side it came from.
  std::vector<Event> take(const Configuration& c);

  /// Takes the sides of the grips anew, which mean something else after their friction has come to rest or given way.
  void renew(const Configuration& c);

  /// The sides: 1, −1, or 0 of a switch that says nothing.
  const std::vector<int>& sides() const { return side_; }

  void save(Snapshot& snapshot) const;
  void load(const Snapshot& snapshot);

  /// Time from `from`, which is h before `to`, to the first change of a side: of the cubic that has the values and rates of both
  /// ends, so that a phase which begins and ends within the step is seen.
  std::optional<double> first_change(const std::vector<Switch>& from, const std::vector<Switch>& to, double h) const;
  /// Time from `to` to the first change after it, of the same cubics continued, within `ahead`.
  std::optional<double> next_change(const std::vector<Switch>& from, const std::vector<Switch>& to, double h, double ahead) const;
  /// Where a rate is unknown takes the slope of the chord from one to the other, h later, at both.
  static void complete(std::vector<Switch>& from, std::vector<Switch>& to, double h);
  /// Time from an instant to the next change of a side, as its values and rates foretell; infinite when none is near. What stays
  /// within rounding of zero for longer than `tolerance` rests there: its side changes when it leaves.
  double time_to_change(const std::vector<Switch>& now, double tolerance) const;
  /// How long the values of switches that are to change within `ahead` take to pass through their rounding: no event can be met
  /// more sharply.
  double blur(const std::vector<Switch>& now, double ahead) const;

 private:
  SolverContext& context_;
  struct Place {
    int part, index;
  };
  std::vector<Place> places_;
  std::vector<int> side_;      ///< 1 or −1
  std::vector<Switch> taken_;  ///< values that take() has seen last
  double taken_at_ = 0;
};

/// First t in [0, h] at which the cubic with values a, b and rates da, db at 0 and h is below −`band`, when there is one: the
/// instant at which it passes −band.
std::optional<double> first_descent(double a, double da, double b, double db, double h, double band);

/// Ends steps at events. An event is met by a step that ends a little before it and a drift across it; steps are never
/// shorter than `shortest()`, below which the inverse square of the step enlarges rounding: there it drifts. Controlled steps may
/// end as far before it as a drift is more accurate than they are.
class EventLocator {
 public:
  EventLocator(SolverContext& context, Scheme& scheme);

  bool active() const { return active_; }
  double shortest() const { return 0.01 * step_; }
  /// How far an event may be from the end of the step before it.
  double tolerance() const { return tolerance_; }

  /// Steps are of this length now.
  void step_is(double step);

  Switches& switches() { return switches_; }
  /// A new multiple of H is the aim, or a controlled step has met no event: the guard against chattering counts anew.
  void new_target() { located_ = 0; }

  struct Finding {
    enum class Kind {
      none,   ///< no event in the step just tried: it stands
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
  /// How long a controlled step of at most `size` is to be tried: to the first event that the last step lets expect, a little
  /// less than to there.
  double foresee(const Configuration& from, double size);
  /// A step of `size` stands; what was seen at its beginning tells where the next event is. After drifts nothing does.
  void stepped(double size) {
    before_ = began_;
    last_step_ = size;
  }
  void forget() { last_step_ = 0; }
  /// After an attempt of `size` from `from` to `to`, converged or not.
  Finding inspect(const Configuration& from, double size, bool converged, Configuration& to);

  /// The sides, and how often events were met on the way to the present multiple of H.
  void save(Snapshot& snapshot) const;
  void load(const Snapshot& snapshot);

  /// Whether the guard has switched location off for the rest of the step; true once per run.
  bool chatters();

 private:
  /// Time to the first event within `size` as velocities and accelerations of `from` foretell it; `now`: the switches there.
  std::optional<double> coasting_change(const Configuration& from, std::vector<Switch> now, double size) const;
  /// How far before an event a step of `size` may end.
  double reach(double size) const;
  /// How sharply events within `ahead` of these values are met.
  void sharpen(const std::vector<Switch>& now, double ahead);

  Scheme& scheme_;
  Switches switches_;
  double step_, sharpness_, tolerance_ = 0;
  double part_of_drift_ = 0;  ///< of a controlled step
  bool active_ = false;
  std::vector<Switch> began_;   ///< at the beginning of the last attempt
  std::vector<Switch> before_;  ///< at the beginning of the last step that stands
  double last_step_ = 0;        ///< from there to the beginning of the next; 0: not known
  double aimed_ = 0;            ///< the present attempt is to end near an event that was expected within so long; 0: it is not
  int located_ = 0;
  bool chattered_ = false, told_ = false;
};

}  // namespace engrane::solve
