// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "math/vector.hpp"

namespace engrane {

/// The rotation about y by the angle |y| (Rodrigues), accurate to rounding for any y.
Mat3 rotation_exp(const Vec3& y);

/// exp(y) − 1, each entry accurate to rounding of its own size for small y.
Mat3 rotation_change(const Vec3& y);

/// The rotation vector of R, of length at most π; accurate to rounding near 0 and near π.
Vec3 rotation_log(const Mat3& R);

/// Tangent operator: exp(y + dy) = exp(y) exp(T(y) dy) to first order (material, or right, increments).
Mat3 rotation_tangent(const Vec3& y);

/// Ṫ(y) w with the `rate` ẏ; with w = ẏ what the material angular acceleration T(y) ÿ + Ṫ(y) ẏ has beside its first term.
Vec3 rotation_tangent_rate(const Vec3& y, const Vec3& rate, const Vec3& w);

/// The rotation nearest to a matrix that rounding has left nearly orthogonal.
Mat3 orthonormalized(const Mat3& R);

}  // namespace engrane
