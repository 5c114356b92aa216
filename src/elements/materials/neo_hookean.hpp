// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "elements/materials/elasticity.hpp"

namespace engrane::elements::materials {

/// The answer of a material to a strain of Green and Lagrange.
struct Response {
  Voigt stress = Voigt::Zero();    ///< second Piola–Kirchhoff
  Moduli moduli = Moduli::Zero();  ///< derivative of the stress by the strain
  double energy = 0;               ///< per volume of the reference configuration
  double transverse = 0;           ///< strain along z
};

/// Of a strain with all six components; in plane stress the one along z is found. Not a number where C = I + 2E is not positive
/// definite.
Response respond(const NeoHookean& material, Hypothesis hypothesis, Voigt strain);

}  // namespace engrane::elements::materials
