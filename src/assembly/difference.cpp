// SPDX-License-Identifier: BSD-3-Clause
#include "assembly/difference.hpp"

#include <algorithm>
#include <cassert>
#include <functional>

#include "math/rotation.hpp"

namespace engrane {

std::vector<double> difference(const Configuration& to, const Configuration& from) {
  assert(to.nodes.size() == from.nodes.size() && to.scalars.size() == from.scalars.size());
  std::vector<double> motion(6 * to.nodes.size() + to.scalars.size());
  double* next = motion.data();
  for (std::size_t i = 0; i < to.nodes.size(); ++i) {
    const NodeState &a = from.nodes[i], &b = to.nodes[i];
    const Vec3 translation = b.x - a.x;
    // with equal rotations the logarithm would differ from zero by rounding errors
    const Vec3 rotation = a.R == b.R ? Vec3(Vec3::Zero()) : rotation_log(a.R.transpose() * b.R);
    next = std::copy_n(translation.data(), 3, next);
    next = std::copy_n(rotation.data(), 3, next);
  }
  std::transform(to.scalars.begin(), to.scalars.end(), from.scalars.begin(), next, std::minus<>());
  return motion;
}

}  // namespace engrane
