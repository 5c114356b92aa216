// SPDX-License-Identifier: BSD-3-Clause
#include "math/stress.hpp"

#include <Eigen/Eigenvalues>

namespace engrane {

std::array<double, 3> principal_stresses(std::span<const double> s) {
  if (s.size() == 4) {
    const double middle = (s[0] + s[1]) / 2, radius = std::hypot((s[0] - s[1]) / 2, s[3]);
    return {middle + radius, middle - radius, s[2]};
  }
  const Vec3 values = Eigen::SelfAdjointEigenSolver<Mat3>(symmetric_tensor(s), Eigen::EigenvaluesOnly).eigenvalues();
  return {values[2], values[1], values[0]};
}

}  // namespace engrane
