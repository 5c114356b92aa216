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

/// Energies of the whole model, and the work done since the start.
struct EnergyBalance {
  double kinetic = 0, potential = 0;
  double strain = 0;  ///< part of the potential energy that the cells hold
  double external_work = 0, dissipated = 0;
  double initial = 0;        ///< kinetic + potential at the start
  double largest_error = 0;  ///< largest |error()| so far
  double passed = 0;         ///< integral of the absolute values of all power in and out
  double exchanged = 0;      ///< largest change of the potential energy since the start

  /// Upper bound for a plausible error(): the initial energy, the energy that passed through the model, and the largest change
  /// of the potential energy.
  double handled() const { return std::abs(initial) + passed + exchanged; }
  /// Error of the energy balance: E − E₀ − W + D.
  double error() const { return kinetic + potential - initial - external_work + dissipated; }
};

/// Sum over all elements, on every rank; each rank evaluates its own. Collective.
Energies total_energies(Assembler& assembler, const Configuration& c);

/// Work of loads and supports between two equilibria, by the trapezoidal rule along the straight line between them.
double static_work(Assembler& assembler, Reactions& supports, Configuration from, const Configuration& to);

/// Keeps the energy balance from step to step. The work during motion is the integral of the power: by the trapezoidal rule,
/// or, with error-controlled and therefore possibly long steps, by a polynomial through the last few values of the power.
class EnergyLedger {
 public:
  /// `moves`: the analysis has velocities; otherwise the work is computed between equilibria.
  EnergyLedger(Assembler& assembler, Reactions& supports, bool moves);

  /// Adds the next accepted configuration; the first one is the start. Collective.
  void add(const Configuration& c, const std::vector<Reaction>& reactions);
  void integrate_smoothly() { smooth_ = true; }
  /// Discards the previous powers, as after an event: the power may jump.
  void forget() { powers_.clear(); }
  /// Continues from the power of the last configuration, but not with its slope, as after a corner of a function of time.
  void begin_anew();
  const EnergyBalance& balance() const { return balance_; }

  /// For a restart. load() also takes the last configuration added from the snapshot.
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
  Extrapolation powers_;        ///< external and dissipated power
  PackedConfiguration before_;  ///< statics: the last equilibrium
};

}  // namespace engrane::observe
