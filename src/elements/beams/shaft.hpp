// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "model/registry.hpp"

namespace engrane::elements::beams {

/// Card of a stepped shaft. `SHAFT N n1 … n2 MAT m D d1 d2 … [AT s1 …] [D_END …] [BORE …] [BORE_END …] [PIECES n] …`
///
/// A list with a single value applies it to all steps, discs, wheels or bearings.
struct ShaftData {
  std::vector<int> nodes;                                      ///< stations along the axis, in order from end to end
  int material = 0;                                            ///< of `.MAT`
  std::vector<double> places;                                  ///< boundaries between steps: distances from the first node
  std::vector<double> diameter, diameter_end, bore, bore_end;  ///< of the steps; `_end`: at the far end of conical steps
  std::optional<double> shear;                                 ///< shear factor of all sections
  std::optional<int> pieces;                                   ///< between stations or step ends; default: by slenderness
  std::optional<double> damping;                               ///< Kelvin–Voigt damping time; none: that of the material

  std::vector<int> discs;  ///< stations
  std::vector<double> mass, polar, diametral;
  std::vector<int> wheels;  ///< stations
  std::vector<double> outer, inner, width;
  std::optional<double> density;
  std::vector<int> bearings;  ///< stations
  std::vector<double> radial_stiffness, axial_stiffness, radial_damping, axial_damping;
};

/// SHAFT (ARBRE): a stepped shaft with its discs, wheels and bearings; expands to BEAM, INERTIA and BEARING.
ElementType shaft_type();

}  // namespace engrane::elements::beams
