// SPDX-License-Identifier: BSD-3-Clause
// Profile relief: each pair of teeth on the path of contact is a separate spring, and starts to press later by the amount
// removed from its flanks.
#pragma once

#include <vector>

#include "model/function.hpp"

namespace engrane::elements::gears {

/// Profiles of a pair of wheels along the path of contact. Positions ζ on the path are measured from the pitch point in the
/// direction in which A moves; amounts are in the units of u_m, along the circumference.
struct ToothRelief {
  /// Material removed towards one end of the path: amount (s/length)^exponent, with s the distance from the start of the
  /// relief.
  struct Ramp {
    bool at_recess = true;  ///< the end where A's tips touch; otherwise where B's do
    double amount = 0, length = 0, exponent = 2;
  };
  std::vector<Ramp> ramps;
  double approach = 0, recess = 0;  ///< front flanks touch from −approach to recess
  double base_pitch = 1;
  double flank = 0.25;  ///< of A's front flank from the middle of its tooth, in pitches
  double edge = 0;  ///< length over which a pair enters or leaves, half inside the path and half outside; its stiffness is C²

  bool active() const { return !ramps.empty(); }
  /// Mean number of pairs on the path, which share k_m: each has k_m/ε.
  double contact_ratio() const { return (approach + recess) / base_pitch; }
  /// ζ at which a ramp starts.
  double start(const Ramp& ramp) const { return ramp.at_recess ? recess - ramp.length : ramp.length - approach; }
  /// δ(ζ): material removed at ζ, with derivatives with respect to ζ.
  Function::Jet lacking(double place) const;
  /// Weight of a pair at ζ: 1 on the path, 0 beyond.
  Function::Jet present(double place) const;
};

}  // namespace engrane::elements::gears
