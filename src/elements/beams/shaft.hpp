// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "model/registry.hpp"

namespace engrane::elements::beams {

/// Card of a stepped shaft. `SHAFT N n1 … n2 MAT m D d1 d2 … [AT s1 …] [D_END …] [BORE …] [BORE_END …] [PIECES n] …`
///
/// A list with one value holds it for all steps, discs, wheels or bearings.
struct ShaftData {
  std::vector<int> nodes;                                      ///< stations on the axis in turn, from end to end
  int material = 0;                                            ///< of `.MAT`
  std::vector<double> places;                                  ///< where steps end, from the first node along the axis
  std::vector<double> diameter, diameter_end, bore, bore_end;  ///< of steps; at their ends, of cones
  std::optional<double> shear;                                 ///< factor of all sections
  std::optional<int> pieces;                                   ///< between two places; by itself by length and diameter
  double damping = 0;                                          ///< a time

  std::vector<int> discs;  ///< stations
  std::vector<double> mass, polar, diametral;
  std::vector<int> wheels;  ///< stations
  std::vector<double> outer, inner, width;
  std::optional<double> density;
  std::vector<int> bearings;  ///< stations
  std::vector<double> radial_stiffness, axial_stiffness, radial_damping, axial_damping;
};

/// SHAFT (ARBRE): a stepped shaft with what sits on it, written out as BEAM, INERTIA and BEARING.
ElementType shaft_type();

}  // namespace engrane::elements::beams
