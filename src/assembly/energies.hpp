// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "assembly/assembler.hpp"
#include "assembly/reactions.hpp"

namespace engrane {

/// Sum over all elements, on every rank; each rank evaluates its own. Collective.
Energies total_energies(Assembler& assembler, const Configuration& c);

/// Work of loads, drives and supports along the straight line between two equilibria, with the forces of the first and with
/// those of the second.
struct StaticWork {
  double first = 0, second = 0;
  double varied = 0;        ///< sum of the differences between both, each taken as positive
  double handled = 0;       ///< sum of the works, each taken as positive
  bool dissipates = false;  ///< elements that resist velocities would take part of it
  bool gives = false;       ///< elements without an energy, as a spring law of the time, do work on the others

  /// Adds the works of one load each.
  void add(const std::vector<double>& with_first, const std::vector<double>& with_second);
  /// By the trapezoidal rule.
  double mean() const { return 0.5 * (first + second); }
  /// Energy lost in a jump, if the potential energy has changed by `change`; 0 if a path of equilibria may lead from one to the
  /// other. Along a path, forces lie between those of both equilibria, and so do the work and the change of the energy: the
  /// rest of the smaller work is lost. Negative if energy has come from nothing: no motion leads there. Since paths are not
  /// straight, `bend` of the differences between the works is allowed.
  double lost(double change, double bend = 0.5) const;
};
StaticWork static_work(Assembler& assembler, Reactions& supports, Configuration from, const Configuration& to);

}  // namespace engrane
