// SPDX-License-Identifier: BSD-3-Clause
#include "solve/schemes/collocation.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace engrane::solve {

Collocation Collocation::radau() {
  Collocation r;
  constexpr Eigen::Index stages = 3;
  r.c.resize(stages);
  r.c << (4 - std::sqrt(6.0)) / 10, (4 + std::sqrt(6.0)) / 10, 1;
  // C(s): Σ_j a_ij c_j^(k−1) = c_i^k / k for k = 1 to s
  Eigen::MatrixXd powers(stages, stages), integrals(stages, stages);
  for (Eigen::Index i = 0; i < stages; ++i)
    for (Eigen::Index k = 0; k < stages; ++k) {
      powers(i, k) = std::pow(r.c[i], static_cast<double>(k));
      integrals(i, k) = powers(i, k) * r.c[i] / static_cast<double>(k + 1);
    }
  r.a = integrals * powers.inverse();
  r.inverse = r.a.inverse();

  const Eigen::EigenSolver<Eigen::MatrixXd> eigen(r.inverse);
  r.transform.resize(stages, stages);
  Eigen::Index column = 0;
  for (Eigen::Index k = 0; k < stages; ++k) {
    const auto value = eigen.eigenvalues()[k];
    const Eigen::VectorXcd vector = eigen.eigenvectors().col(k);
    if (value.imag() > 0) continue;  // its conjugate stands for both
    r.blocks.push_back({column, value.real(), -value.imag()});
    r.transform.col(column++) = vector.real();
    if (r.blocks.back().complex()) r.transform.col(column++) = vector.imag();
  }
  r.untransform = r.transform.inverse();

  // weights b̂ with Σ b̂_i c_i^(k−1) = 1/k for k = 1 to s; the first sum includes the weight of the beginning, the real
  // eigenvalue of a, a choice of IV.8 that damps stiff components
  for (const Block& block : r.blocks)
    if (!block.complex()) r.embedded_first = 1 / block.alpha;
  Eigen::VectorXd conditions(stages);
  for (Eigen::Index k = 0; k < stages; ++k) conditions[k] = 1 / static_cast<double>(k + 1);
  conditions[0] -= r.embedded_first;
  const Eigen::VectorXd weights = powers.transpose().inverse() * conditions;
  r.embedded = r.inverse.transpose() * (weights - r.a.row(stages - 1).transpose());
  return r;
}

}  // namespace engrane::solve
