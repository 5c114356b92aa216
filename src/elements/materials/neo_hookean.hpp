// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "elements/materials/elasticity.hpp"

namespace engrane::elements::materials {

/// Response of a material to a Green–Lagrange strain.
struct Response {
  Voigt stress = Voigt::Zero();    ///< second Piola–Kirchhoff
  Moduli moduli = Moduli::Zero();  ///< derivative of the stress by the strain
  double energy = 0;               ///< per unit reference volume
  double transverse = 0;           ///< strain along z
};

/// Response to a strain with all six components; in plane stress the component along z is computed. NaN if C = I + 2E is not
/// positive definite.
Response respond(const NeoHookean& material, Hypothesis hypothesis, Voigt strain);

}  // namespace engrane::elements::materials
