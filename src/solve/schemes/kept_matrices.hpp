// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "solve/schemes/stage_solver.hpp"

namespace engrane::solve {

/// K, C and M of simplified Newton iterations for steps of any length, one set for each phase between two events: a tooth that
/// meets the next one again finds the matrices of the last time. A phase is known by the sides that the switches of elements are
/// on, by those before the event, and by how many steps have been made in it.
class KeptMatrices {
 public:
  KeptMatrices(Assembler& assembler, StageSolver& solver);

  /// An event leads to these sides of all switches.
  void enter(const std::vector<int>& sides);
  /// A step has been made since then.
  void step();
  /// Makes the solver's systems for steps of h from what is kept for this phase; false where there is nothing, or where the
  /// scales of multipliers have changed.
  bool recall(double h);
  /// Makes them of what they were made of last, which may be of the phase before: behind load().
  bool restore(double h);
  /// Evaluates what is to be kept for this phase, at `c`, and makes the systems for steps of h.
  void evaluate(const Configuration& c, double h);
  /// What is kept for this phase is no good any more.
  void drop() { sets_.erase(phase_); }
  /// The same of all.
  void clear() { sets_.clear(); }

  /// Where the sets were evaluated; load() evaluates them there again.
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
  std::size_t most_ = 1;      ///< sets
  std::vector<int> phase_;    ///< sides, sides before, steps; empty before the first event
  std::vector<int> current_;  ///< of what the systems were made of last
  std::map<std::vector<int>, Set> sets_;
};

}  // namespace engrane::solve
