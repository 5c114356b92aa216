// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "solve/schemes/solver_context.hpp"

namespace engrane::solve {

/// Leads a structure that has no equilibrium nearby down the slope of its energy, to where it would come to rest after snapping
/// through: implicit Euler steps of D ẏ = −r(y), longer and longer (pseudo-transient continuation; Kelley and Keyes 1998, SIAM J.
/// Numer. Anal. 35, 508). D stands for a viscosity that resists each unknown by its own length.
class Descent {
 public:
  explicit Descent(SolverContext& context);

  /// Moves `to` from where `apply` puts it for `unknowns` (as in Newton::solve) until out-of-balance forces are a small part of
  /// the largest on the way: near an equilibrium, from where Newton's iteration leads on. False, with `to` undefined, if they do
  /// not become so. Collective.
  bool descend(const Newton::Apply& apply, std::vector<double> unknowns, Configuration& to);

 private:
  /// A step from unknowns_ against `viscosity`: a work, for each unknown that moves by its length. Returns the largest work of
  /// an out-of-balance force at its end; nothing, with unknowns_ undefined, if the step is too long.
  std::optional<double> creep(double viscosity, const Newton::Apply& apply, Configuration& to);
  /// Whether the structure has moved so far that it is falling, not snapping.
  bool runs_away() const;
  /// Largest force (by equation) times the length of its unknown, and largest change of an unknown over its length; multipliers
  /// do not count.
  double largest_work(std::span<const double> forces) const;
  double largest_part(std::span<const double> changes) const;

  SolverContext& context_;
  std::vector<double> lengths_;   ///< by equation; 0 for multipliers
  std::vector<double> unknowns_;  ///< by equation; multipliers as λ
  Owned<Vec> residual_, change_, diagonal_;
};

}  // namespace engrane::solve
