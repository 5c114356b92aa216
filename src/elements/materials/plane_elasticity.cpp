// SPDX-License-Identifier: BSD-3-Clause
#include "elements/materials/plane_elasticity.hpp"

namespace engrane::elements::materials {

PlaneElasticity isotropic(Hypothesis hypothesis, double young, double poisson, double density) {
  constexpr Eigen::Index zz = 2, xy = 3;
  const double shear = young / (2 * (1 + poisson));
  PlaneElasticity law{Eigen::Matrix4d::Zero(), Eigen::Vector4d::Zero(), density};
  Eigen::Matrix4d& D = law.stiffness;
  D(xy, xy) = shear;
  if (hypothesis == Hypothesis::plane_stress) {
    const double normal = young / (1 - poisson * poisson);
    D.topLeftCorner<2, 2>() << normal, poisson * normal, poisson * normal, normal;
    law.expansion[0] = law.expansion[1] = -poisson / (1 - poisson);
    return law;
  }
  const double lame = young * poisson / ((1 + poisson) * (1 - 2 * poisson));
  D.topLeftCorner<zz + 1, zz + 1>().setConstant(lame);
  D.diagonal().head<zz + 1>().array() += 2 * shear;
  return law;
}

}  // namespace engrane::elements::materials
