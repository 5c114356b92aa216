// SPDX-License-Identifier: BSD-3-Clause
#include "math/matrix6.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace engrane {

std::optional<Mat6> symmetric_6(std::span<const double> values) {
  Mat6 m = Mat6::Zero();
  if (values.size() == 6) {
    for (Eigen::Index i = 0; i < 6; ++i) m(i, i) = values[static_cast<std::size_t>(i)];
  } else if (values.size() == 21) {
    std::size_t next = 0;
    for (Eigen::Index i = 0; i < 6; ++i)
      for (Eigen::Index j = i; j < 6; ++j) m(i, j) = m(j, i) = values[next++];
  } else {
    return {};
  }
  return m;
}

double definiteness(const Mat6& m) {
  Vec6 scale = m.diagonal();
  for (Eigen::Index i = 0; i < 6; ++i) scale[i] = scale[i] > 0 ? 1 / std::sqrt(scale[i]) : 1;
  const Mat6 scaled = scale.asDiagonal() * m * scale.asDiagonal();
  const Vec6 values = Eigen::SelfAdjointEigenSolver<Mat6>(scaled, Eigen::EigenvaluesOnly).eigenvalues();
  return values[0] / values.cwiseAbs().maxCoeff();
}

}  // namespace engrane
