// SPDX-License-Identifier: BSD-3-Clause
#include "elements/materials/elasticity.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "math/stress.hpp"

namespace engrane::elements::materials {

Elastic isotropic(double young, double poisson) {
  return orthotropic({Vec3::Constant(young), Vec3::Constant(poisson), Vec3::Constant(young / (2 * (1 + poisson)))});
}

Elastic orthotropic(const Orthotropic& c) {
  Elastic material;
  material.compliance.diagonal() << c.young.cwiseInverse(), c.shear.cwiseInverse();
  for (Eigen::Index i = 0; i < 3; ++i) {  // ν12 and ν23 belong to axes 1 and 2, ν13 to axes 1 and 3
    const Eigen::Index a = i == 2 ? 0 : i, b = i == 2 ? 2 : i + 1;
    material.compliance(a, b) = material.compliance(b, a) = -c.poisson[i] / c.young[a];
  }
  return material;
}

NeoHookean neo_hookean(double young, double poisson) {
  return {young / (2 * (1 + poisson)), young * poisson / ((1 + poisson) * (1 - 2 * poisson))};
}

bool is_stable(const Elastic& material) { return Eigen::LLT<Moduli>(material.compliance).info() == Eigen::Success; }

bool is_plane(const Elastic& material) {
  constexpr double rounding = 1e-12;
  return material.compliance.bottomLeftCorner<2, 4>().norm() <= rounding * material.compliance.norm() &&
         material.expansion.tail<2>().norm() <= rounding * material.expansion.norm();
}

Elastic turned(const Elastic& material, const Mat3& axes) {
  // column j: global components of the j-th unit strain in material axes
  Moduli strain;
  for (Eigen::Index j = 0; j < 6; ++j) {
    Mat3 unit = Mat3::Zero();
    unit(component_rows[j], component_columns[j]) = unit(component_columns[j], component_rows[j]) = j < 3 ? 1 : 0.5;
    strain.col(j) = components_of(axes * unit * axes.transpose());
    strain.col(j).tail<3>() *= 2;
  }
  return {strain * material.compliance * strain.transpose(), strain * material.expansion, material.density, material.damping,
          material.neo_hookean};
}

Elasticity law_of(Hypothesis hypothesis, const Elastic& material) {
  Elasticity law;
  law.expansion = law.growth = material.expansion;
  law.density = material.density;
  law.damping = material.damping;
  law.neo_hookean = material.neo_hookean;
  constexpr std::array<Eigen::Index, 3> in_plane{0, 1, 3};
  constexpr Eigen::Index zz = 2;
  if (hypothesis == Hypothesis::plane_stress) {
    const Mat3 stiffness = Mat3(material.compliance(in_plane, in_plane)).inverse();
    law.stiffness(in_plane, in_plane) = stiffness;
    law.transverse(in_plane) = stiffness * material.compliance(in_plane, zz);
    return law;
  }
  law.stiffness = Eigen::LLT<Moduli>(material.compliance).solve(Moduli::Identity());
  if (hypothesis == Hypothesis::plane_strain) {
    // with free in-plane expansion, E_zz = C_zz S_zz + α_zz ΔT = 0 gives S_zz = −α_zz ΔT/C_zz
    law.held = 1 / material.compliance(zz, zz);
    law.growth(in_plane) -= law.held * material.expansion[zz] * material.compliance(in_plane, zz);
  }
  return law;
}

}  // namespace engrane::elements::materials
