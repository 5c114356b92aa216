// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "base/snapshot.hpp"
#include "deck/cards/cards.hpp"
#include "output/results_layout.hpp"

namespace engrane::output {

/// Compares channels with what the deck's `.CHK` records expect, while the run goes on.
///
/// VALUE with a time is the sample at that time when there is one (to 1e-9 of a step), else the cubic through the
/// four samples around it: fourth order where the channel is smooth. VALUE without a time is the last sample. The
/// other measures are taken over WINDOW, or over the whole run, of the channel as straight lines between samples, cut
/// at the window's ends: MIN, MAX, MEAN and RMS over time (RMS about zero, not about the mean), AMPLITUDE = (MAX - MIN)/2.
///
/// A check passes when |value - expected| is at most ATOL, or at most RTOL |expected|; RTOL is 1e-6 when neither is given. A
/// time or window that the run never reached fails.
class Checks {
 public:
  /// A check and the place of its channel in the values of observe().
  struct Resolved {
    deck::CheckCard card;
    std::size_t channel = 0;
  };
  explicit Checks(std::vector<Resolved> checks);

  /// Every step, the start included, in the order of time. Repeating a time replaces what was said of it.
  /// `regular` false: an instant between the steps, close to others, which a value is not interpolated from.
  void observe(double time, std::span<const double> values, bool regular = true);

  /// One result per check, in the deck's order; after the last step.
  std::vector<CheckResult> results() const;
  bool empty() const { return checks_.empty(); }

  /// What the checks remember, for a restart. A check that the snapshot does not know begins with the restart, and fails when
  /// it asks for an earlier time.
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
    bool exact = false;                 ///< `before` holds the sample at that time, and nothing else
    bool seen = false;
    double first_time = 0, last_value = 0;  ///< when seen
    // measures over a window
    double least = 0, largest = 0, area = 0, squares = 0, covered = 0;
    bool any = false;
  };
  void observe_value(Measured& m, Sample sample) const;
  void observe_window(Measured& m, Sample sample) const;
  CheckResult result(const Measured& m) const;
  /// The value of a check and, when there is none, why.
  double value(const Measured& m, std::string& remark) const;
  /// Times closer than this are the same.
  double slack(double time) const;

  std::vector<Measured> checks_;
  double last_time_ = 0, last_step_ = 0;
  bool started_ = false;
};

/// How a check is called: `ELEMENT 1 NORMAL_FORCE at t = 1`.
std::string check_title(const deck::CheckCard& card);

}  // namespace engrane::output
