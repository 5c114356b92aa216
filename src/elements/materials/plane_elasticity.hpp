// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace engrane::elements::materials {

/// What a cell supposes of the third direction.
enum class Hypothesis : unsigned char {
  plane_stress,  ///< no stress along z
  plane_strain,  ///< no strain along z
  axisymmetric   ///< z is the circumference, x the radius
};

/// Linear law between the stresses (second Piola–Kirchhoff where displacements are large) and the strains of Green and Lagrange
/// in a plane: S = D E with xx, yy, zz and xy in this order, the shear strain the engineering one.
struct PlaneElasticity {
  Eigen::Matrix4d stiffness;
  /// E_zz = expansion · E: what plane stress makes of the strain along z; zero otherwise.
  Eigen::Vector4d expansion;
  double density = 0;
};

/// Isotropic: Young's modulus, Poisson's ratio. Of plane stress the law is reduced by S_zz = 0.
PlaneElasticity isotropic(Hypothesis hypothesis, double young, double poisson, double density);

}  // namespace engrane::elements::materials
