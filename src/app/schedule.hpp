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
  /// Sets instants within controlled steps at which values are needed in addition to the even ones; nothing else is due there.
  void ask(std::vector<double> times);

  struct Due {
    bool sample = false, frame = false, restart = false;
  };
  /// What is due at an accepted step, including the start. `regular` false: an instant between regular steps, such as an event.
  /// Spectra need samples at equal intervals, so only energies and checks use it.
  Due at(double time, double step, bool regular, bool last);

  /// Output instants between the two ends of a controlled step, ascending: those of ask(), and the even ones unless histories
  /// are kept of every step.
  std::vector<double> between(double from, double to) const;
  /// Whether the time is an even instant or the end of the run.
  bool even(double time) const;
  /// Whether the time is one of ask() but not an even instant.
  bool beside_even(double time) const;
  /// The interval between even instants, or `step` if results are kept at the ends of steps.
  double even_step(double step) const { return even_ > 0 ? even_ : step; }
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
  double start_, end_, step_;
  bool controlled_;
  std::vector<double> wanted_;  ///< instants of ask(), ascending
  double even_ = 0;             ///< interval between even instants; 0: results at the ends of steps
  double asked_ = 0;            ///< last regular time passed to at(), including the margin for early times
  Interval sample_, frame_;
  std::optional<Interval> restart_;
};

}  // namespace engrane::app
