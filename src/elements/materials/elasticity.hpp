// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

#include "math/vector.hpp"

namespace engrane::elements::materials {

/// Assumption on the third direction of a cell.
enum class Hypothesis : unsigned char {
  plane_stress,  ///< no stress along z
  plane_strain,  ///< no strain along z
  axisymmetric,  ///< z is circumferential, x radial
  solid          ///< none: three-dimensional
};

/// Components xx, yy, zz, xy, yz, zx of a symmetric tensor. The last three of a strain are engineering shear strains.
using Voigt = Eigen::Matrix<double, 6, 1>;
using Moduli = Eigen::Matrix<double, 6, 6>;

/// Isotropic material for large strains (neo_hookean.hpp), given by its Lamé constants in the reference configuration.
struct NeoHookean {
  double shear = 0;   ///< μ
  double lambda = 0;  ///< λ
};
NeoHookean neo_hookean(double young, double poisson);

/// Linear elastic material: E = C S + α ΔT, with S the stresses (second Piola–Kirchhoff for large displacements), E the
/// Green–Lagrange strains and C the compliance.
struct Elastic {
  Moduli compliance = Moduli::Zero();
  Voigt expansion = Voigt::Zero();  ///< α: thermal strain per degree
  double density = 0;
  double damping = 0;                          ///< Kelvin–Voigt time τ: rates of strain cause the stress τ C⁻¹ Ė
  std::optional<NeoHookean> neo_hookean = {};  ///< law for large strains; `compliance` is its linearisation at rest
};

Elastic isotropic(double young, double poisson);

/// Engineering constants of an orthotropic material along its axes 1, 2, 3.
struct Orthotropic {
  Vec3 young;    ///< E1, E2, E3
  Vec3 poisson;  ///< ν12, ν23, ν13: ν_ij = −ε_j/ε_i for uniaxial stress along i
  Vec3 shear;    ///< G12, G23, G13
};
/// Orthotropic material in its own axes (Jones 1999, Mechanics of Composite Materials, 2.3).
Elastic orthotropic(const Orthotropic& constants);
/// Whether the compliance is positive definite.
bool is_stable(const Elastic& material);
/// Whether z is a material axis: in-plane loads and heating cause no shear yz or zx.
bool is_plane(const Elastic& material);

/// Rotates a material so that its axes become the columns of `axes`.
Elastic turned(const Elastic& material, const Mat3& axes);

/// Law of a cell: S = D (E − α ΔT), or a neo-Hookean law whose tangent at rest is D.
struct Elasticity {
  Moduli stiffness = Moduli::Zero();
  Voigt expansion = Voigt::Zero();
  /// Free thermal strain per degree in the strain components of the cell: α, and in plane strain also the Poisson effect of the
  /// stress along z.
  Voigt growth = Voigt::Zero();
  /// Plane strain: a freely expanded cell still stores the energy held (α_zz ΔT)²/2 per unit volume. Otherwise zero.
  double held = 0;
  /// Plane stress: E_zz = α_zz ΔT + transverse · (E − α ΔT). Otherwise zero.
  Voigt transverse = Voigt::Zero();
  double density = 0;
  double damping = 0;  ///< τ: stresses τ D Ė are added to S
  std::optional<NeoHookean> neo_hookean = {};
};
/// Law of a cell. For plane stress, S_zz = S_yz = S_zx = 0 is eliminated.
Elasticity law_of(Hypothesis hypothesis, const Elastic& material);

}  // namespace engrane::elements::materials
