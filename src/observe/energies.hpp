// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "assembly/assembler.hpp"
#include "assembly/energies.hpp"
#include "assembly/fillings.hpp"
#include "base/snapshot.hpp"
#include "math/extrapolation.hpp"
#include "observe/packed_configuration.hpp"

namespace engrane::observe {

/// A load step between two equilibria that no path of stable equilibria joins: the structure snapped through or fell over in
/// between, and lost energy that statics do not show. If it gained energy instead, it cannot have reached the second by itself.
struct Jump {
  double begin = 0, end = 0;  ///< times of the equilibria
  double lost = 0;            ///< energy; negative: won; 0: there was no jump
};

/// Energies of the whole model, and the work done since the start.
struct EnergyBalance {
  double kinetic = 0, potential = 0;
  double strain = 0;  ///< part of the potential energy that the cells hold
  double external_work = 0, dissipated = 0;
  double initial = 0;        ///< kinetic + potential at the start
  double largest_error = 0;  ///< largest |error()| so far
  double passed = 0;         ///< integral of the absolute values of all power in and out
  double exchanged = 0;      ///< largest change of the potential energy since the start
  Jump jump;                 ///< statics: the jump with the largest energy

  /// Upper bound for a plausible error(): the initial energy, the energy that passed through the model, and the largest change
  /// of the potential energy.
  double handled() const { return std::abs(initial) + passed + exchanged; }
  /// Error of the energy balance: E − E₀ − W + D.
  double error() const { return kinetic + potential - initial - external_work + dissipated; }
};

/// Inner points of Lobatto quadrature with four points, (1 ∓ 1/√5)/2, as fractions of the step.
inline constexpr std::array lobatto_points{0.2763932022500210, 0.7236067977499790};

/// Keeps the energy balance from step to step. The work during motion is the integral of the power: by the trapezoidal rule,
/// or, with error-controlled and therefore possibly long steps, by Lobatto quadrature where the power inside the step is known,
/// and by a polynomial through the last few values of the power elsewhere. That of filling is computed from contents.
class EnergyLedger {
 public:
  /// `moves`: the analysis has velocities; otherwise the work is computed between equilibria.
  EnergyLedger(Assembler& assembler, Reactions& supports, bool moves);

  /// How a step ends.
  struct End {
    bool corner = false;   ///< a function of time has a corner there: powers are those before it
    bool jump = false;     ///< a function of time has jumped since the last configuration, while nothing moved
    bool impulse = false;  ///< speeds of drives have jumped: the change of the kinetic energy is their work, as joints do none
  };
  /// Adds the next accepted configuration; the first one is the start. Collective.
  void add(const Configuration& c, const std::vector<Reaction>& reactions, const End& end);
  /// Takes a configuration inside the step whose end is added next, at the first of the lobatto_points and then at the second.
  /// The work there is known when that end has been added. Collective.
  void add_inside(const Configuration& c, const std::vector<Reaction>& reactions);
  /// The balances at the points inside the step that was added last, once.
  std::vector<EnergyBalance> take_inside();
  void integrate_smoothly() { smooth_ = true; }
  /// Discards the previous powers, as after an event: the power may jump. In the step that is added next, it may do so behind
  /// the points inside.
  void forget();
  /// Continues from the power of the last configuration behind a corner of a function of time, which may jump there, and not with
  /// its slope. Collective.
  void begin_anew(const Configuration& c, const std::vector<Reaction>& reactions);
  const EnergyBalance& balance() const { return balance_; }

  /// For a restart. load() also takes the last configuration added from the snapshot.
  void save(Snapshot& snapshot) const;
  void load(const Snapshot& snapshot);

 private:
  struct Moment {
    double time = 0;
    Energies energies;  ///< the external power is that without filling
    Fillings::At fillings;
  };
  Moment moment_at(const Configuration& c, const std::vector<Reaction>& reactions);
  /// The same with the powers that functions of time give a little before (−1) or after (1) a corner at its end.
  Moment beside_corner(const Configuration& c, const std::vector<Reaction>& reactions, int side);
  /// Work of functions of time that have jumped since the last configuration, such as temperatures and lengths.
  double work_of_jump(const Configuration& c) const;
  /// Integrates the powers from the last moment to this one, by the polynomial or the trapezoidal rule.
  void integrate_to(const Moment& moment);
  /// Integrates the powers over the whole step with the points inside.
  void integrate_over_inside(const Moment& end);
  /// Makes the points inside ends of steps of their own.
  void end_steps_inside();
  /// Sum over all ranks of a work of filling. Collective.
  double over_ranks(double work) const;
  /// Adds the work of filling since the last moment.
  void fill_to(const Moment& moment);
  /// Makes this the last moment, after its work has been added.
  void arrive(const Moment& moment);

  Assembler& assembler_;
  Reactions& supports_;
  Fillings fillings_;
  bool filled_ = false;  ///< any rank has elements that are filled
  Fillings::At last_fillings_;
  bool moves_;
  bool started_ = false;
  EnergyBalance balance_;
  double initial_potential_ = 0, last_potential_ = 0;
  double external_power_ = 0, dissipated_power_ = 0, last_time_ = 0;
  double last_time_before_ = 0;  ///< of the configuration before the one that is, or was last, added
  bool smooth_ = false;
  Extrapolation powers_;        ///< external and dissipated power
  std::vector<Moment> inside_;  ///< of the step whose end is added next
  std::vector<EnergyBalance> balances_inside_;
  PackedConfiguration before_;  ///< statics: the last equilibrium
};

}  // namespace engrane::observe
