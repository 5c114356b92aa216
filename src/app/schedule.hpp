// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "base/snapshot.hpp"
#include "deck/cards/cards.hpp"

namespace engrane::app {

/// When samples, frames and kept restart points are due.
class Schedule {
 public:
  Schedule(const deck::SteppingCard& stepping, const deck::ArchiveCard& archive);
  /// Instants within controlled steps at which values are asked for, beside the even ones: nothing else is due there.
  void ask(std::vector<double> times);

  struct Due {
    bool sample = false, frame = false, restart = false;
  };
  /// What is due at an accepted step, the start included. `regular` false: an instant between the steps, close to others; spectra
  /// want samples at equal intervals, so what lies between multiples of H for an event is for energies and checks only.
  Due at(double time, double step, bool regular, bool last);

  /// The instants between two ends of controlled steps at which something may be due: the even ones, none where histories are of
  /// every step; and those of ask().
  std::vector<double> between(double from, double to) const;
  /// Is this such an instant, or the end?
  bool even(double time) const;
  /// Is it one of ask(), and no even one?
  bool beside_even(double time) const;
  /// The time between even ones, or a `step` where ends of steps serve.
  double even_step(double step) const { return even_ > 0 ? even_ : step; }
  /// Steps are controlled by their error (`.SUB TOL`).
  bool controlled() const { return controlled_; }

  /// About how many samples a run to the end has.
  std::size_t expected_samples() const;

  void save(Snapshot& snapshot) const;
  void load(const Snapshot& snapshot);

 private:
  /// Something that is due at even intervals from the start.
  struct Interval {
    double length = 0;  ///< 0: always
    double next = 0;
    bool due(double time, double start);
  };
  double start_, end_, step_;
  bool controlled_;
  std::vector<double> wanted_;  ///< of ask(), ascending
  double even_ = 0;             ///< time between even instants; 0: the ends of steps serve
  double asked_ = 0;            ///< the last regular time that was asked about, with what counts as early
  Interval sample_, frame_;
  std::optional<Interval> restart_;
};

}  // namespace engrane::app
