// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

namespace engrane {

using Mat6 = Eigen::Matrix<double, 6, 6>;
using Vec6 = Eigen::Matrix<double, 6, 1>;

/// The symmetric matrix of 6 values, its diagonal, or of 21, its upper triangle row by row; nothing of another number.
std::optional<Mat6> symmetric_6(std::span<const double> values);

/// The smallest eigenvalue of a symmetric matrix over the largest in size, scaled to a diagonal of ones since its rows have
/// different units.
double definiteness(const Mat6& m);

}  // namespace engrane
