// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "base/snapshot.hpp"
#include "deck/cards/cards.hpp"
#include "output/results_layout.hpp"
#include "output/window.hpp"

namespace engrane::output {

/// Compares channels with the values expected by the deck's `.CHK` records, while the run progresses.
///
/// VALUE with a time is the sample at that time if there is one (to 1e-9 of a step), otherwise the cubic through the four
/// samples around it between events and corners: fourth order where the channel is smooth. VALUE without a time is the last
/// sample. The other measures are taken over WINDOW, or over the whole run, as Window says: MIN, MAX, MEAN and RMS over time
/// (RMS about zero, not about the mean), AMPLITUDE = (MAX - MIN)/2.
///
/// A check passes if |value - expected| is at most ATOL, or at most RTOL |expected|; RTOL is 1e-6 if neither is given. A time
/// or window that the run never reached fails.
class Checks {
 public:
  /// A check and the index of its channel in the values of observe().
  struct Resolved {
    deck::CheckCard card;
    std::size_t channel = 0;
  };
  explicit Checks(std::vector<Resolved> checks);

  /// Observes every step in order of time, including the start. Repeating a time, as at a jump, replaces its sample for VALUE
  /// and for the interval that follows. `regular` false: an instant between the steps and close to others; VALUE ignores it.
  /// `corner`: an event or a corner of a function of time, across which nothing is smooth.
  void observe(double time, std::span<const double> values, bool regular = true, bool corner = false);

  /// One result per check, in the order of the deck. Call after the last step.
  std::vector<CheckResult> results() const;
  bool empty() const { return checks_.empty(); }

  /// State of the checks, for a restart. A check that is not in the snapshot starts at the restart, and fails if it asks for an
  /// earlier time.
  void save(Snapshot& snapshot) const;
  void load(const Snapshot& snapshot);

 private:
  struct Sample {
    double time = 0;
    double value = 0;
  };
  struct Measured {
    Resolved resolved;
    std::vector<Sample> before, after;  ///< VALUE: the last three before its time, the first three after it
    bool exact = false;                 ///< `before` holds only the sample at exactly that time
    bool closed = false;                ///< a corner lies behind the samples after its time
    bool seen = false;
    double first_time = 0, last_value = 0;  ///< valid if `seen`
    Window window;                          ///< of the other measures
  };
  void observe_value(Measured& m, Sample sample, bool regular, bool corner) const;
  CheckResult result(const Measured& m) const;
  /// Returns the value of a check; if there is none, returns NaN and sets `remark` to the reason.
  double value(const Measured& m, std::string& remark) const;
  /// Times closer than this count as equal.
  double slack(double time) const;

  std::vector<Measured> checks_;
  double last_time_ = 0, last_step_ = 0;
  bool started_ = false;
};

/// Whether a check is an extreme or a mean over time, not a value at one time.
bool is_over_time(const deck::CheckCard& card);
/// Title of a check: `ELEMENT 1 NORMAL_FORCE at t = 1`.
std::string check_title(const deck::CheckCard& card);

}  // namespace engrane::output
