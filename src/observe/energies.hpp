// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <vector>

#include "assembly/assembler.hpp"
#include "base/snapshot.hpp"
#include "math/extrapolation.hpp"
#include "observe/packed_configuration.hpp"
#include "observe/reactions.hpp"

namespace engrane::observe {

/// Energies of the whole model and the work done since the start.
struct EnergyBalance {
  double kinetic = 0, potential = 0;
  double strain = 0;  ///< part of the potential energy: of cells
  double external_work = 0, dissipated = 0;
  double initial = 0;        ///< kinetic + potential at the start
  double largest_error = 0;  ///< largest |error()| so far
  double passed = 0;         ///< the integral of all power in and out, whatever its sign
  double exchanged = 0;      ///< largest change of the potential energy since the start

  /// What was in the machine at the start, has gone through it or changed its form there: more than this cannot be amiss.
  double handled() const { return std::abs(initial) + passed + exchanged; }
  /// What the balance fails to close by: E − E₀ − W + D.
  double error() const { return kinetic + potential - initial - external_work + dissipated; }
};

/// Sum over all elements, on every rank; each rank evaluates its own. Collective.
Energies total_energies(Assembler& assembler, const Configuration& c);

/// Work of loads and supports between two equilibria, by the trapezoidal rule along the straight way between them.
double static_work(Assembler& assembler, Reactions& supports, Configuration from, const Configuration& to);

/// Keeps the balance from step to step. Work in motion is the integral of power by the trapezoidal rule, or of the polynomial
/// through the last few powers where steps are controlled, and so may be long.
class EnergyLedger {
 public:
  /// `moves`: the analysis has velocities; else work is that between equilibria.
  EnergyLedger(Assembler& assembler, Reactions& supports, bool moves);

  /// The next accepted configuration, the start first. Collective.
  void add(const Configuration& c, const std::vector<Reaction>& reactions);
  void integrate_smoothly() { smooth_ = true; }
  /// What follows does not continue what was.
  void forget() { powers_.clear(); }
  /// What follows begins with the power of the configuration last added, but does not continue its course.
  void begin_anew();
  const EnergyBalance& balance() const { return balance_; }

  /// For a restart; load() takes the configuration last added from the snapshot too.
  void save(Snapshot& snapshot) const;
  void load(const Snapshot& snapshot);

 private:
  Assembler& assembler_;
  Reactions& supports_;
  bool moves_;
  bool started_ = false;
  EnergyBalance balance_;
  double initial_potential_ = 0;
  double external_power_ = 0, dissipated_power_ = 0, last_time_ = 0;
  bool smooth_ = false;
  Extrapolation powers_;        ///< external and dissipated
  PackedConfiguration before_;  ///< of statics: the last equilibrium
};

}  // namespace engrane::observe
