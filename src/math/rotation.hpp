// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "math/vector.hpp"

namespace engrane {

/// Rotation matrix of the rotation vector y (Rodrigues' formula), accurate to rounding for any y.
Mat3 rotation_exp(const Vec3& y);

/// exp(y) − 1, each entry accurate relative to its own magnitude for small y.
Mat3 rotation_change(const Vec3& y);

/// Rotation vector of R, of length at most π; accurate to rounding near 0 and near π. Of a linear_rotation() its own vector.
Vec3 rotation_log(const Mat3& R);

/// Tangent operator: exp(y + dy) = exp(y) exp(T(y) dy) to first order (material, i.e. right, increments).
Mat3 rotation_tangent(const Vec3& y);

/// Ṫ(y) w for the rate ẏ. With w = ẏ it is the second term of the material angular acceleration T(y) ÿ + Ṫ(y) ẏ.
Vec3 rotation_tangent_rate(const Vec3& y, const Vec3& rate, const Vec3& w);

/// Rotation matrix nearest to R, which must be orthogonal up to rounding.
Mat3 orthonormalized(const Mat3& R);

}  // namespace engrane
