// SPDX-License-Identifier: BSD-3-Clause
// Pitch cones of a hypoid pair from its design data.
#pragma once

#include <optional>

namespace engrane::elements::gears {

/// Design data of a hypoid pair. Angles in radians; spiral angles are given without hand: the pinion's is positive, the ring's
/// is positive if its hand is opposite. Two of offset, ring_spiral and ring_cone determine the pair. If only one is given, the
/// ring's pitch apex lies at the crossing point of the axles, so that offset 0 is the spiral bevel pair.
struct HypoidDesign {
  int pinion_teeth = 1, ring_teeth = 1;
  double shaft_angle = 0;
  double pinion_spiral = 0;
  std::optional<double> ring_radius, normal_module;  ///< exactly one of them
  std::optional<double> offset;  ///< distance of the axles, positive if the pinion's spiral angle is the larger
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

/// Solves the conditions for two pitch cones in contact with aligned teeth, A. Cardona (1995), (9) and (12). With ε = ψ_P − ψ_G
/// they read
///
///     cosΣ = cosγ_P cosγ_G cosε − sinγ_P sinγ_G                   from Z₁₁ of (9)
///     E sinΣ = (r_P cosγ_G + r_G cosγ_P) sinε                     from the triple product of (12) with both axles
///     r_G cosγ_G sin²Σ = sinγ_G [r_P Z₁₂ + cosΣ r_G Z₂₁]          the ring's apex is the foot of the common normal
///
/// with Z₁₂ = cosγ_G sinγ_P cosε + sinγ_G cosγ_P, Z₂₁ = sinγ_G cosγ_P cosε + cosγ_G sinγ_P (the ring as first wheel), and the
/// pitch radii from 2 r cosψ = z m_n. Returns nothing if no such cones exist.
std::optional<HypoidCones> hypoid_cones(const HypoidDesign& design);

}  // namespace engrane::elements::gears
