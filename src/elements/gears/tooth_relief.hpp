// SPDX-License-Identifier: BSD-3-Clause
// Relief of tooth profiles: every pair of teeth on the path of contact is a spring of its own, and begins to press later by as
// much as was taken off its flanks.
#pragma once

#include <vector>

#include "model/function.hpp"

namespace engrane::elements::gears {

/// The profiles of a pair of wheels along the path of contact. Lengths along the path ζ count from the pitch point in the
/// direction in which A moves; amounts are in the units of u_m, along the circumference.
struct ToothRelief {
  /// Material taken off towards one end of the path: amount (s/length)^exponent, s the way beyond where it begins.
  struct Ramp {
    bool at_recess = true;  ///< the end where A's tips touch; otherwise where B's do
    double amount = 0, length = 0, exponent = 2;
  };
  std::vector<Ramp> ramps;
  double approach = 0, recess = 0;  ///< front flanks touch from −approach to recess
  double base_pitch = 1;
  double flank = 0.25;  ///< of A's front flank from the middle of its tooth, in pitches
  double edge = 0;      ///< way over which a pair comes and goes, half within the path and half beyond: its stiffness is C²

  bool active() const { return !ramps.empty(); }
  /// Pairs on the path in the mean, over which k_m is shared out: each has k_m/ε.
  double contact_ratio() const { return (approach + recess) / base_pitch; }
  /// δ(ζ), what the pair at ζ lacks, with derivatives by ζ.
  Function::Jet lacking(double place) const;
  /// The part of a pair at ζ that is there: 1 on the path, 0 beyond.
  Function::Jet present(double place) const;
};

}  // namespace engrane::elements::gears
