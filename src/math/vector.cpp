// SPDX-License-Identifier: BSD-3-Clause
#include "math/vector.hpp"

namespace engrane {

Vec3 perpendicular(const Vec3& a) {
  int least = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(a[i]) < std::abs(a[least])) least = i;
  return cross(a, Vec3(Vec3::Unit(least))).normalized();
}

}  // namespace engrane
