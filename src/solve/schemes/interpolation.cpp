// SPDX-License-Identifier: BSD-3-Clause
#include "solve/schemes/interpolation.hpp"

#include "math/rotation.hpp"

namespace engrane::solve {

Interpolation::Interpolation(const MotionSlots& motion, const Configuration& from, const Configuration& to)
    : motion_(motion), from_(from), begin_(from.time), step_(to.time - from.time) {
  const std::size_t n = motion.size(), scalars = 6 * from.nodes.size();
  std::vector<double> end(n, 0.0), rate = motion.velocities(to);
  for (std::size_t i = 1; i < from.nodes.size(); ++i) {
    const NodeState &a = from.nodes[i], &b = to.nodes[i];
    const Vec3 moved = b.x - a.x, turned = rotation_log(a.R.transpose() * b.R);
    // Ẏ = T(y)⁻¹ W
    const Vec3 turning = rotation_tangent(turned).partialPivLu().solve(b.W);
    for (Eigen::Index k = 0; k < 3; ++k) {
      const std::size_t slot = 6 * i + static_cast<std::size_t>(k);
      end[slot] = moved[k];
      end[slot + 3] = turned[k];
      rate[slot + 3] = turning[k];
    }
  }
  for (std::size_t i = 0; i < from.scalars.size(); ++i) end[scalars + i] = to.scalars[i] - from.scalars[i];
  first_ = motion.velocities(from);
  second_ = motion.accelerations(from);
  third_.resize(n);
  fourth_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    first_[i] *= step_;
    second_[i] *= 0.5 * step_ * step_;
    const double left = end[i] - first_[i] - second_[i], slope = step_ * rate[i] - first_[i] - 2 * second_[i];
    third_[i] = 4 * left - slope;
    fourth_[i] = slope - 3 * left;
  }
}

void Interpolation::at(double time, Configuration& c) const {
  const double s = (time - begin_) / step_;
  const std::size_t n = motion_.size();
  std::vector<double> y(n), v(n);
  for (std::size_t i = 0; i < n; ++i) {
    y[i] = s * (first_[i] + s * (second_[i] + s * (third_[i] + s * fourth_[i])));
    v[i] = (first_[i] + s * (2 * second_[i] + s * (3 * third_[i] + s * 4 * fourth_[i]))) / step_;
  }
  c = from_;
  c.time = time;
  motion_.move(from_, y, c);
  for (std::size_t i = 1; i < c.nodes.size(); ++i) {
    const Vec3 turning(v[6 * i + 3], v[6 * i + 4], v[6 * i + 5]), W = c.nodes[i].T * turning;
    for (std::size_t k = 0; k < 3; ++k) v[6 * i + 3 + k] = W[static_cast<Eigen::Index>(k)];
    c.nodes[i].T.setIdentity();  // this is no end of a step that has unknowns
  }
  motion_.set_velocities(v, c);
}

}  // namespace engrane::solve
