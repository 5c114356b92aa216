// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "base/snapshot.hpp"
#include "deck/cards/cards.hpp"

namespace engrane::app {

/// Determines when samples, frames and kept restart points are due.
class Schedule {
 public:
  Schedule(const deck::SteppingCard& stepping, const deck::ArchiveCard& archive);
  /// Sets instants within controlled steps at which values are needed in addition to the even ones: at `times`, and where each
  /// step is divided into `parts`. Nothing else is due there.
  void ask(std::vector<double> times, int parts);

  struct Due {
    bool sample = false, frame = false, restart = false;
  };
  /// What is due at an accepted step, including the start. `regular` false: an instant between regular steps, such as an event.
  /// Spectra need samples at equal intervals, so only energies and checks use it.
  Due at(double time, double step, bool regular, bool last);
  /// What is due at an instant of between().
  Due within(double time);

  /// Output instants between the two ends of a controlled step, ascending: those of ask(), and the even ones, at which samples
  /// or fields are due: the former unless histories are kept of every step, the latter if `.SAI FIELDS` is given.
  std::vector<double> between(double from, double to) const;
  /// Whether something is due at the end of a controlled step at this time.
  bool even(double time) const;
  /// Whether the time is one of ask() but not an even instant.
  bool beside_even(double time) const { return !on_any(time); }
  /// The interval between samples, or between fields where histories are kept of every step, or `step`.
  double even_step(double step) const { return even_.empty() ? step : even_.front(); }
  /// Whether steps are controlled by their error (`.SUB TOL`).
  bool controlled() const { return controlled_; }

  /// Approximate number of samples of a complete run.
  std::size_t expected_samples() const;

  void save(Snapshot& snapshot) const;
  void load(const Snapshot& snapshot);

 private:
  /// Something due at equal intervals from the start.
  struct Interval {
    double length = 0;  ///< 0: always due
    double next = 0;
    bool due(double time, double start);
  };
  /// What is due at an even instant of a controlled step, or at its end if histories are kept of every step (`at_end`).
  Due even_due(double time, double early, bool at_end, bool last);
  bool on(double interval, double time) const;
  bool on_any(double time) const;

  double start_, end_, step_;
  bool controlled_;
  std::vector<double> wanted_;  ///< instants of ask(), ascending
  int parts_ = 1;
  std::vector<double> even_;  ///< intervals between even instants of controlled steps: of samples, then of fields
  double asked_ = 0;          ///< last regular time passed to at(), including the margin for early times
  Interval sample_, frame_;
  bool fields_even_ = false;  ///< fields of controlled steps are due at even instants of their own
  std::optional<Interval> restart_;
};

}  // namespace engrane::app
