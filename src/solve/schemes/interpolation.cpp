// SPDX-License-Identifier: BSD-3-Clause
#include "solve/schemes/interpolation.hpp"

#include "math/rotation.hpp"

namespace engrane::solve {

namespace {

using Slots = Eigen::Map<Vec3>;

/// Translation slots of a node, and its rotation slots.
Slots translation(std::vector<double>& slots, std::size_t node) { return Slots(&slots[6 * node]); }
Slots rotation(std::vector<double>& slots, std::size_t node) { return Slots(&slots[6 * node + 3]); }

}  // namespace

Interpolation::Interpolation(const MotionSlots& motion, const Configuration& from, const Configuration& to,
                             std::span<const double> ended)
    : motion_(motion), from_(from), begin_(from.time), step_(to.time - from.time) {
  const std::size_t n = motion.size(), scalars = 6 * from.nodes.size();
  std::vector<double> end(n, 0.0), rate = motion.velocities(to), second = motion.accelerations(to);
  for (std::size_t i = 1; i < from.nodes.size(); ++i) {
    const NodeState &a = from.nodes[i], &b = to.nodes[i];
    const Vec3 turned = rotation_log(a.R.transpose() * b.R);
    translation(end, i) = b.x - a.x;
    rotation(end, i) = turned;
    // W = T(y) ẏ and Ẇ = T(y) ÿ + Ṫ(y) ẏ
    const auto tangent = rotation_tangent(turned).partialPivLu();
    const Vec3 turning = tangent.solve(b.W);
    rotation(rate, i) = turning;
    rotation(second, i) = tangent.solve(b.A - rotation_tangent_rate(turned, turning, turning));
  }
  for (std::size_t i = 0; i < from.scalars.size(); ++i) end[scalars + i] = ended[i] - from.scalars[i];
  first_ = motion.velocities(from);
  second_ = motion.accelerations(from);
  third_.resize(n);
  fourth_.resize(n);
  fifth_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    first_[i] *= step_;
    second_[i] *= 0.5 * step_ * step_;
    // what the parabola from the beginning lacks at the end
    const double left = end[i] - first_[i] - second_[i], slope = step_ * rate[i] - first_[i] - 2 * second_[i],
                 bend = 0.5 * step_ * step_ * second[i] - second_[i];
    third_[i] = 10 * left - 4 * slope + bend;
    fourth_[i] = -15 * left + 7 * slope - 2 * bend;
    fifth_[i] = 6 * left - 3 * slope + bend;
  }
}

void Interpolation::at(double time, Motion& m) const {
  const double s = (time - begin_) / step_;
  const std::size_t n = motion_.size();
  m.y.resize(n);
  m.rates.resize(n);
  m.second.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    m.y[i] = s * (first_[i] + s * (second_[i] + s * (third_[i] + s * (fourth_[i] + s * fifth_[i]))));
    m.rates[i] = (first_[i] + s * (2 * second_[i] + s * (3 * third_[i] + s * (4 * fourth_[i] + s * 5 * fifth_[i])))) / step_;
    m.second[i] = (2 * second_[i] + s * (6 * third_[i] + s * (12 * fourth_[i] + s * 20 * fifth_[i]))) / (step_ * step_);
  }
}

void Interpolation::place(double time, const Motion& m, Configuration& c) const {
  c = from_;
  c.time = time;
  motion_.move(from_, m.y, c);
  std::vector<double> v = m.rates, a = m.second;
  for (std::size_t i = 1; i < c.nodes.size(); ++i) {
    const Vec3 turned(Eigen::Map<const Vec3>(&m.y[6 * i + 3])), turning = rotation(v, i), second = rotation(a, i);
    rotation(v, i) = c.nodes[i].T * turning;
    rotation(a, i) = c.nodes[i].T * second + rotation_tangent_rate(turned, turning, turning);
    c.nodes[i].T.setIdentity();  // not the end of a step with unknowns
  }
  motion_.set_velocities(v, c);
  motion_.set_accelerations(a, c);
}

}  // namespace engrane::solve
