// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace engrane::elements::bearings {

/// Hertzian point contact of two bodies (Johnson, Contact Mechanics, 1985, §4.2): Q = stiffness · δ^(3/2), with the maximum
/// pressure p₀ = pressure · Q^(1/3).
struct PointContact {
  double stiffness = 0;  ///< force / length^(3/2)
  double pressure = 0;
};

/// `along` and `across` are the sums of the bodies' principal curvatures in two perpendicular planes, both positive. `modulus`
/// is E* = 1/((1 − ν₁²)/E₁ + (1 − ν₂²)/E₂).
PointContact point_contact(double along, double across, double modulus);

}  // namespace engrane::elements::bearings
