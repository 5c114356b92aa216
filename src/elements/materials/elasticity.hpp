// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

#include "math/vector.hpp"

namespace engrane::elements::materials {

/// What a cell supposes of the third direction.
enum class Hypothesis : unsigned char {
  plane_stress,  ///< no stress along z
  plane_strain,  ///< no strain along z
  axisymmetric,  ///< z is the circumference, x the radius
  solid          ///< nothing: it has three dimensions
};

/// Components xx, yy, zz, xy, yz, zx of a symmetric tensor. Of strains the last three are the engineering shear strains.
using Voigt = Eigen::Matrix<double, 6, 1>;
using Moduli = Eigen::Matrix<double, 6, 6>;

/// An isotropic material for strains of any size (neo_hookean.hpp), by the constants of Lamé that it has at rest.
struct NeoHookean {
  double shear = 0;   ///< μ
  double lambda = 0;  ///< λ
};
NeoHookean neo_hookean(double young, double poisson);

/// A linear elastic material: E = C S + α ΔT, with S the stresses (second Piola–Kirchhoff where displacements are large) and E
/// the strains of Green and Lagrange.
struct Elastic {
  Moduli compliance = Moduli::Zero();
  Voigt expansion = Voigt::Zero();  ///< α: strain of a free body for one degree
  double density = 0;
  std::optional<NeoHookean> neo_hookean = {};  ///< where strains are not small; the others are its derivatives at rest
};

/// Young's modulus, Poisson's ratio.
Elastic isotropic(double young, double poisson);

/// Engineering constants of an orthotropic material along its axes 1, 2, 3.
struct Orthotropic {
  Vec3 young;    ///< E1, E2, E3
  Vec3 poisson;  ///< ν12, ν23, ν13: strain along the second axis for a stress along the first, its sign changed
  Vec3 shear;    ///< G12, G23, G13
};
/// In the axes of the material (Jones 1999, Mechanics of Composite Materials, 2.3).
Elastic orthotropic(const Orthotropic& constants);
/// Whether any stress stores energy.
bool is_stable(const Elastic& material);
/// Whether the material has z as one of its axes, so that what is plane stays plane.
bool is_plane(const Elastic& material);

/// The material whose axes are the columns of `axes`.
Elastic turned(const Elastic& material, const Mat3& axes);

/// The law of a cell: S = D (E − α ΔT), or that of a neo-Hookean material with D at rest.
struct Elasticity {
  Moduli stiffness = Moduli::Zero();
  Voigt expansion = Voigt::Zero();
  /// Of the strains that the cell has, those of a body free to grow: α, and where strain along z is none, as much more as the
  /// stress there makes of it.
  Voigt growth = Voigt::Zero();
  /// A body that has grown so still has the energy held (α_zz ΔT)²/2 per volume; zero but where strain along z is none.
  double held = 0;
  /// E_zz = α_zz ΔT + transverse · (E − α ΔT): what plane stress makes of the strain along z; zero otherwise.
  Voigt transverse = Voigt::Zero();
  double density = 0;
  std::optional<NeoHookean> neo_hookean = {};
};
/// Of plane stress the law is reduced by S_zz = S_yz = S_zx = 0.
Elasticity law_of(Hypothesis hypothesis, const Elastic& material);

}  // namespace engrane::elements::materials
