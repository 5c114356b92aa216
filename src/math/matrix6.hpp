// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

namespace engrane {

using Mat6 = Eigen::Matrix<double, 6, 6>;
using Vec6 = Eigen::Matrix<double, 6, 1>;

/// Builds a symmetric matrix from 6 values (its diagonal) or 21 (its upper triangle, row by row). Empty for any other number.
std::optional<Mat6> symmetric_6(std::span<const double> values);

/// Smallest eigenvalue of a symmetric matrix over the largest magnitude of one. The matrix is first scaled to a unit diagonal,
/// as its rows have different units.
double definiteness(const Mat6& m);

}  // namespace engrane
