// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "deck/schema/schema.hpp"

namespace engrane::deck {

/// `.BPR I 1 CIRCLE 0.05`, `.BPR I 2 EA 1D7 GA 4D6 4D6 GJ 8D5 EI 8D5 8D5 M 1`: the section of a beam.
struct ProfileCard {
  Tagged shape;                                            ///< CIRCLE d, TUBE d inner, RECTANGLE h b, H h b tw tf, …
  std::vector<double> hole;                                ///< POLYGON: corners of its hole
  std::optional<std::array<double, 2>> offset;             ///< position of the centroid of a shape, on axes 2 and 3
  std::optional<double> area;                              ///< with `moments` and `torsion`: a shape given by its constants
  std::optional<std::array<double, 2>> moments;            ///< second moments of area I2, I3, about axes 2 and 3
  std::optional<double> torsion;                           ///< torsion constant
  std::optional<std::array<double, 2>> factors;            ///< shear correction factors along axes 2 and 3
  std::optional<double> stretching, twisting;              ///< EA, GJ
  std::optional<std::array<double, 2>> shearing, bending;  ///< GA2 GA3; EI2 EI3
  std::vector<double> stiffness;                           ///< 21 values: upper triangle of the 6×6
  std::optional<double> mass;                              ///< per length
  std::vector<double> inertia;                             ///< per length, about axes 1 2 3, or about 1 only
  std::optional<std::array<double, 2>> center;             ///< centre of mass, on axes 2 and 3
};

}  // namespace engrane::deck
