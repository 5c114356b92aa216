// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "solve/schemes/stage_solver.hpp"

namespace engrane::solve {

/// K, C and M of simplified Newton iterations for steps of any length, one set for each phase between two events: a tooth that
/// meets the next one again reuses the matrices of the last time. A phase is identified by the sides of the elements' switches,
/// by the sides before the event, and by the number of steps made in it.
class KeptMatrices {
 public:
  KeptMatrices(Assembler& assembler, StageSolver& solver);

  /// Enters the phase with these sides of all switches, after an event.
  void enter(const std::vector<int>& sides);
  /// Counts a step of this phase.
  void step();
  /// Forms the solver's systems for steps of h from the matrices kept for this phase; false if there are none, or if the scales
  /// of multipliers have changed.
  bool recall(double h);
  /// Forms them from the set used last, which may be of the phase before; for use after load().
  bool restore(double h);
  /// Evaluates the matrices of this phase at `c`, and forms the systems for steps of h.
  void evaluate(const Configuration& c, double h);
  /// The matrices that the solver's systems were last formed from; null if they have been discarded since.
  const StageMatrices* current() const;
  /// Discards the matrices of this phase.
  void drop() { sets_.erase(phase_); }
  /// Discards all matrices.
  void clear() { sets_.clear(); }

  /// Saves where the sets were evaluated; load() evaluates them there again.
  void save(Snapshot& snapshot) const;
  void load(const Snapshot& snapshot);

 private:
  bool combine(const std::vector<int>& phase, double h);

  struct Set {
    Configuration at;
    std::vector<double> scale;
    StageMatrices matrices;
  };

  Assembler& assembler_;
  StageSolver& solver_;
  std::size_t most_ = 1;      ///< largest number of sets
  std::vector<int> phase_;    ///< sides, sides before, steps; empty before the first event
  std::vector<int> current_;  ///< phase of the set used last
  std::map<std::vector<int>, Set> sets_;
};

}  // namespace engrane::solve
