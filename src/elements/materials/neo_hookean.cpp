// SPDX-License-Identifier: BSD-3-Clause
#include "elements/materials/neo_hookean.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "math/stress.hpp"

namespace engrane::elements::materials {

namespace {

/// Strain along z for which the stress along z is zero: C_zz = e^y with μ (e^y − 1) + λ/2 (y + ln d) = 0, d the determinant of
/// the in-plane part of C. The left side is increasing and convex in y, so that Newton's iteration converges from any start.
double free_strain(const NeoHookean& material, const Voigt& strain) {
  const double d = 2 * (strain[0] + strain[1]) + 4 * strain[0] * strain[1] - strain[3] * strain[3];  // determinant minus 1
  if (!(d > -1)) return std::numeric_limits<double>::quiet_NaN();
  const double log_d = std::log1p(d), half = material.lambda / 2;
  constexpr int most = 100;
  constexpr double rounding = 1e-15;
  double y = 0;
  for (int i = 0; i < most; ++i) {
    const double change = -(material.shear * std::expm1(y) + half * (y + log_d)) / (material.shear * std::exp(y) + half);
    y += change;
    if (std::abs(change) <= rounding * std::abs(y)) break;
  }
  return std::expm1(y) / 2;
}

/// Bonet and Wood (2008), Nonlinear Continuum Mechanics for Finite Element Analysis, (6.27) to (6.32):
/// W = μ/2 (tr C − 3) − μ ln J + λ/2 (ln J)², S = μ (I − C⁻¹) + λ ln J C⁻¹. Evaluated without cancellation at small strains.
Response elastic_response(const NeoHookean& material, Hypothesis hypothesis, Voigt strain) {
  const bool plane_stress = hypothesis == Hypothesis::plane_stress;
  if (plane_stress) strain[2] = free_strain(material, strain);
  Mat3 twice;  // C − I
  twice << 2 * strain[0], strain[3], strain[5], strain[3], 2 * strain[1], strain[4], strain[5], strain[4], 2 * strain[2];
  Response response;
  response.transverse = strain[2];
  const Mat3 C = Mat3::Identity() + twice;
  if (Eigen::LLT<Mat3>(C).info() != Eigen::Success || !strain.allFinite()) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    response.stress.setConstant(none);
    response.moduli.setConstant(none);
    response.energy = none;
    return response;
  }
  const double trace = twice.trace(), minors = (trace * trace - twice.squaredNorm()) / 2;
  const double log_J = std::log1p(trace + minors + twice.determinant()) / 2;
  const Mat3 G = C.inverse();
  const Mat3 S = material.shear * G * twice + material.lambda * log_J * G;
  response.stress = components_of(S);
  response.energy = material.shear / 2 * (trace - 2 * log_J) + material.lambda / 2 * log_J * log_J;
  const double shear = material.shear - material.lambda * log_J;
  for (Eigen::Index a = 0; a < 6; ++a)
    for (Eigen::Index b = 0; b < 6; ++b) {
      const Eigen::Index i = component_rows[a], j = component_columns[a], k = component_rows[b], l = component_columns[b];
      response.moduli(a, b) = material.lambda * G(i, j) * G(k, l) + shear * (G(i, k) * G(j, l) + G(i, l) * G(j, k));
    }
  if (plane_stress) {  // eliminate the strain along z
    const Voigt column = response.moduli.col(2);
    response.moduli -= column * column.transpose() / column[2];
    response.stress[2] = 0;
  }
  return response;
}

}  // namespace

/// Multiplicative split F = F_e F_θ with F_θ = θ I (Vujošević and Lubarda 2002, Theor. Appl. Mech. 28–29, 379): the energy is
/// that of the freely expanded material, W = θ³ W_e(C_e) with C_e = C/θ². Hence S = θ S_e, ∂S/∂E = ∂S_e/∂E_e / θ and
/// ∂W/∂θ = θ² (3 W_e − S_e : C_e). In plane stress W does not depend on the strain along z to first order.
Response respond(const NeoHookean& material, Hypothesis hypothesis, const Voigt& strain, double growth) {
  const double stretch = 1 + growth, square = stretch * stretch, free = growth * (2 + growth) / 2;
  Voigt elastic = strain;
  elastic.head<3>().array() -= free;
  elastic /= stretch > 0 ? square : std::numeric_limits<double>::quiet_NaN();
  Response response = elastic_response(material, hypothesis, elastic);
  response.by_growth = square * (3 * response.energy - response.stress.head<3>().sum() - 2 * response.stress.dot(elastic));
  response.energy *= square * stretch;
  response.stress *= stretch;
  response.moduli /= stretch;
  response.transverse = square * response.transverse + free;
  return response;
}

}  // namespace engrane::elements::materials
