// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "solve/schemes/stage_solver.hpp"

namespace engrane::solve {

/// K, C and M of simplified Newton iterations, one set for each combination of sides that the switches of elements have had: a
/// tooth that meets the next one again finds the matrices of the last time. They serve steps of any length.
class KeptMatrices {
 public:
  KeptMatrices(Assembler& assembler, StageSolver& solver);

  /// The sides of all switches from now on.
  void enter(const std::vector<int>& sides) { sides_ = sides; }
  /// Makes the solver's systems for steps of h from what is kept for these sides; false where there is nothing, or where the
  /// scales of multipliers have changed.
  bool recall(double h);
  /// Evaluates what is to be kept for these sides, at `c`, and makes the systems for steps of h.
  void evaluate(const Configuration& c, double h);
  /// What is kept for these sides is no good any more.
  void drop() { sets_.erase(sides_); }
  /// The same of all.
  void clear() { sets_.clear(); }

  /// Where the sets were evaluated; load() evaluates them there again.
  void save(Snapshot& snapshot) const;
  void load(const Snapshot& snapshot);

 private:
  struct Set {
    Configuration at;
    std::vector<double> scale;
    StageSolver::Matrices matrices;
  };

  Assembler& assembler_;
  StageSolver& solver_;
  std::size_t most_ = 1;  ///< sets
  std::vector<int> sides_;
  std::map<std::vector<int>, Set> sets_;
};

}  // namespace engrane::solve
