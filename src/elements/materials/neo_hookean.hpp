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
  double by_growth = 0;            ///< derivative of the energy by `growth`
};

/// Response to a strain with all six components; in plane stress the component along z is computed. The material expands
/// freely by the stretch 1 + `growth` in all directions: F = (1 + growth) F_e, and only F_e causes stress. NaN if C = I + 2E is
/// not positive definite, or the stretch not positive.
Response respond(const NeoHookean& material, Hypothesis hypothesis, const Voigt& strain, double growth = 0);

}  // namespace engrane::elements::materials
