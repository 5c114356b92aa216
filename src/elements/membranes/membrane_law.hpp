// SPDX-License-Identifier: BSD-3-Clause
// Constitutive law of a membrane: plane stress with a prestress and, if it can wrinkle, the tension field of Pipkin and
// Steigmann.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "elements/materials/elasticity.hpp"

namespace engrane::elements::membranes {

/// Components 11, 22, 12 in an orthonormal frame of the surface; the last component of a strain is 2 E₁₂.
using Plane = Eigen::Vector3d;

/// Default fraction of the stiffness that remains where a skin wrinkles or is slack.
inline constexpr double slack_stiffness = 1e-4;

/// Parameters of an isotropic skin.
struct MembraneLaw {
  double young = 0, poisson = 0;
  double expansion = 0;                              ///< coefficient of thermal expansion
  std::optional<materials::NeoHookean> neo_hookean;  ///< if set, replaces the linear law of `young` and `poisson`
  double tension = 0;               ///< s: isotropic second Piola–Kirchhoff prestress in the reference configuration
  std::optional<double> wrinkling;  ///< ε: fraction of the stiffness that remains where it is not taut; none: no wrinkling
};

/// Law of an isotropic material in plane stress.
MembraneLaw membrane_law(const materials::Elasticity& material);

enum class SkinState : unsigned char { slack, wrinkled, taut };

/// Response of a skin to a Green–Lagrange strain.
struct SkinResponse {
  Plane stress;            ///< second Piola–Kirchhoff
  Eigen::Matrix3d moduli;  ///< derivative of the stress by the strain
  double energy = 0;       ///< per unit reference volume
  double by_growth = 0;    ///< its derivative by the free growth
  double by_tension = 0;   ///< its derivative by the prestress
  double thinning = 1;     ///< current over reference thickness
  double area = 1;         ///< current over reference area of the material, with wrinkles flattened out
  SkinState state = SkinState::taut;
};

/// `growth` is what the material expands by freely in all directions, α ΔT. A linear law has the elastic strain E − α ΔT in the
/// surface, as cells have (docs/elements/structural/cell.md). A neo-Hookean law has F = (1 + α ΔT) F_e.
SkinResponse respond(const MembraneLaw& law, const Plane& strain, double growth = 0);

}  // namespace engrane::elements::membranes
