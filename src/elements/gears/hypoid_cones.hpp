// SPDX-License-Identifier: BSD-3-Clause
// Pitch cones of a hypoid pair from what a designer has.
#pragma once

#include <optional>

namespace engrane::elements::gears {

/// A hypoid pair as designers state it. Angles in radians, spiral angles without their hand: the pinion's is positive, the
/// ring's positive when its hand is the other one. Two of offset, ring_spiral and ring_cone are needed; with one of them the
/// ring's pitch apex lies at the crossing point of the axles, so that an offset of 0 is the spiral bevel pair.
struct HypoidDesign {
  int pinion_teeth = 1, ring_teeth = 1;
  double shaft_angle = 0;
  double pinion_spiral = 0;
  std::optional<double> ring_radius, normal_module;  ///< one of them
  std::optional<double> offset;                      ///< distance of the axles, positive where the pinion's spiral is the larger
  std::optional<double> ring_spiral;
  std::optional<double> ring_cone;
};

/// The pitch cones: both cone angles positive, each wheel widening along its axle.
struct HypoidCones {
  double pinion_cone = 0, ring_cone = 0;
  double ring_spiral = 0;
  double normal_module = 0;
  double offset = 0;
};

/// Solves the conditions under which two pitch cones touch with their teeth in line, A. Cardona (1995), (9) and (12). With
/// ε = ψ_P − ψ_G they read
///
///     cosΣ = cosγ_P cosγ_G cosε − sinγ_P sinγ_G                   from Z₁₁ of (9)
///     E sinΣ = (r_P cosγ_G + r_G cosγ_P) sinε                     from the triple product of (12) with both axles
///     r_G cosγ_G sin²Σ = sinγ_G [r_P Z₁₂ + cosΣ r_G Z₂₁]          the ring's apex is the foot of the common normal
///
/// with Z₁₂ = cosγ_G sinγ_P cosε + sinγ_G cosγ_P, Z₂₁ = sinγ_G cosγ_P cosε + cosγ_G sinγ_P (the ring as first wheel), the
/// pitch radii from 2 r cosψ = z m_n. Nothing when no such cones exist.
std::optional<HypoidCones> hypoid_cones(const HypoidDesign& design);

}  // namespace engrane::elements::gears
