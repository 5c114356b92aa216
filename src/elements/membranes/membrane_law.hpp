// SPDX-License-Identifier: BSD-3-Clause
// What a skin answers to strains in its surface: plane stress with a tension of its own and, where it may wrinkle, the tension
// field of Pipkin and Steigmann.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "elements/materials/elasticity.hpp"

namespace engrane::elements::membranes {

/// Components 11, 22, 12 in an orthonormal frame of the surface; of strains the last one is 2 E₁₂.
using Plane = Eigen::Vector3d;

/// The part of its stiffness that a skin has by itself where it wrinkles or is slack.
inline constexpr double slack_stiffness = 1e-4;

/// The law of an isotropic skin.
struct MembraneLaw {
  double young = 0, poisson = 0;
  std::optional<materials::NeoHookean> neo_hookean;  ///< instead
  double tension = 0;               ///< s: second Piola–Kirchhoff stress in the reference configuration, in all directions
  std::optional<double> wrinkling;  ///< ε: part of the stiffness that is left where it is not taut; none: it cannot wrinkle
};

/// Of an isotropic material in plane stress.
MembraneLaw membrane_law(const materials::Elasticity& material);

enum class SkinState : unsigned char { slack, wrinkled, taut };

/// The answer of a skin to a strain of Green and Lagrange. Energies are per volume of the reference configuration.
struct SkinResponse {
  Plane stress;            ///< second Piola–Kirchhoff
  Eigen::Matrix3d moduli;  ///< derivative of the stress by the strain
  double energy = 0;
  double thinning = 1;  ///< thickness over that of the reference
  double area = 1;      ///< of the material, wrinkles smoothed out, over that of the reference
  SkinState state = SkinState::taut;
};

SkinResponse respond(const MembraneLaw& law, const Plane& strain);

}  // namespace engrane::elements::membranes
