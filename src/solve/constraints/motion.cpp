// SPDX-License-Identifier: BSD-3-Clause
#include "solve/constraints/motion.hpp"

#include <algorithm>

#include "math/linear_rotation.hpp"
#include "math/rotation.hpp"

namespace engrane::solve {

namespace {

/// Returns the rounded sum. `remainder`, what earlier sums left out, is added, and becomes what this sum leaves out (Kahan
/// 1965; Knuth's two-sum, exact whichever term is larger).
double compensated_sum(double a, double b, double& remainder) {
  const double added = b + remainder, sum = a + added, part = sum - a;
  remainder = (a - (sum - part)) + (added - part);
  return sum;
}

/// Compensated product of a rotation and that of an increment in material axes; `remainder` as in compensated_sum().
Mat3 compensated_turn(const Mat3& R, const Vec3& y, Eigen::Ref<Vec3> remainder) {
  const Mat3 change = R * rotation_change(y + remainder), turned = orthonormalized(R + change);
  // the difference of two close matrices is exact, and so is what it lacks of the change
  const Mat3 left = turned.transpose() * (change - (turned - R));
  remainder = 0.5 * Vec3(left(2, 1) - left(1, 2), left(0, 2) - left(2, 0), left(1, 0) - left(0, 1));
  return turned;
}

/// Moves a node that is at its starting point; `y` and `remainder`: its six entries. `adds`: rotation vectors add up.
void move_node(const double* y, double* remainder, bool adds, NodeState& node) {
  for (int k = 0; k < 3; ++k) node.x[k] = compensated_sum(node.x[k], y[k], remainder[k]);
  const Vec3 rotation(y[3], y[4], y[5]);
  if (rotation.isZero(0)) {
    node.T.setIdentity();
  } else if (adds) {
    Vec3 theta = rotation_log(node.R);
    for (int k = 0; k < 3; ++k) theta[k] = compensated_sum(theta[k], rotation[k], remainder[3 + k]);
    node.R = linear_rotation(theta);
    node.T.setIdentity();
  } else {
    node.R = compensated_turn(node.R, rotation, Eigen::Map<Vec3>(remainder + 3));
    node.T = rotation_tangent(rotation);
  }
}

/// Moves the scalars of `to` from `from`; the remainders of `to` must be those of the starting point.
void move_scalars(std::span<const double> from, std::span<const double> y, Configuration& to) {
  const std::size_t first = 6 * to.nodes.size();
  to.scalars.resize(from.size());
  for (std::size_t i = 0; i < from.size(); ++i) to.scalars[i] = compensated_sum(from[i], y[first + i], to.remainders[first + i]);
}

}  // namespace

void MotionSlots::move(const Configuration& from, std::span<const double> y, Configuration& to) const {
  to.remainders = from.remainders;
  for (std::size_t i = 1; i < from.nodes.size(); ++i) {
    to.nodes[i] = from.nodes[i];
    move_node(&y[6 * i], &to.remainders[6 * i], adds_rotations_, to.nodes[i]);
  }
  move_scalars(from.scalars, y, to);
}

void MotionSlots::take_over(Configuration& c) const {
  for (NodeState& node : c.nodes) {
    const bool adds = is_linear_rotation(node.R);
    if (adds == adds_rotations_) continue;
    const Vec3 theta = rotation_log(node.R);
    if (!theta.isZero(0)) node.R = adds_rotations_ ? linear_rotation(theta) : rotation_exp(theta);
  }
}

MotionSlots::Origin::Origin(const Configuration& c) : scalars(c.scalars) {
  if (std::any_of(c.remainders.begin(), c.remainders.end(), [](double left) { return left != 0; })) remainders = c.remainders;
  places.reserve(c.nodes.size());
  for (std::size_t i = 0; i < c.nodes.size(); ++i) {
    places.push_back(c.nodes[i].x);
    if (c.nodes[i].R != Mat3::Identity()) turned.emplace_back(i, c.nodes[i].R);
  }
}

void MotionSlots::move(const Origin& from, std::span<const double> y, Configuration& to) const {
  if (from.remainders.empty())
    std::fill(to.remainders.begin(), to.remainders.end(), 0.0);
  else
    to.remainders = from.remainders;
  auto turned = from.turned.begin();
  for (std::size_t i = 1; i < from.places.size(); ++i) {
    NodeState& node = to.nodes[i];
    while (turned != from.turned.end() && turned->first < i) ++turned;
    node.x = from.places[i];
    if (turned != from.turned.end() && turned->first == i)
      node.R = turned->second;
    else
      node.R.setIdentity();
    move_node(&y[6 * i], &to.remainders[6 * i], adds_rotations_, node);
  }
  move_scalars(from.scalars, y, to);
}

std::vector<double> MotionSlots::velocities(const Configuration& c) const {
  std::vector<double> all;
  all.reserve(size());
  for (const NodeState& n : c.nodes)
    for (const Vec3* part : {&n.v, &n.W}) all.insert(all.end(), part->data(), part->data() + 3);
  all.insert(all.end(), c.scalar_rates.begin(), c.scalar_rates.end());
  return all;
}

std::vector<double> MotionSlots::accelerations(const Configuration& c) const {
  std::vector<double> all;
  all.reserve(size());
  for (const NodeState& n : c.nodes)
    for (const Vec3* part : {&n.a, &n.A}) all.insert(all.end(), part->data(), part->data() + 3);
  all.insert(all.end(), c.scalar_accelerations.begin(), c.scalar_accelerations.end());
  return all;
}

void MotionSlots::set_velocities(std::span<const double> v, Configuration& c) const {
  for (std::size_t i = 1; i < c.nodes.size(); ++i) {
    c.nodes[i].v = Vec3(v[6 * i], v[6 * i + 1], v[6 * i + 2]);
    c.nodes[i].W = Vec3(v[6 * i + 3], v[6 * i + 4], v[6 * i + 5]);
  }
  const std::size_t first = 6 * c.nodes.size();
  for (std::size_t i = 0; i < c.scalar_rates.size(); ++i) c.scalar_rates[i] = v[first + i];
}

void MotionSlots::set_accelerations(std::span<const double> a, Configuration& c) const {
  for (std::size_t i = 1; i < c.nodes.size(); ++i) {
    c.nodes[i].a = Vec3(a[6 * i], a[6 * i + 1], a[6 * i + 2]);
    c.nodes[i].A = Vec3(a[6 * i + 3], a[6 * i + 4], a[6 * i + 5]);
  }
  const std::size_t first = 6 * c.nodes.size();
  for (std::size_t i = 0; i < c.scalar_accelerations.size(); ++i) c.scalar_accelerations[i] = a[first + i];
}

void MotionSlots::scatter(std::span<const double> unknowns, std::span<double> motion) const {
  for (std::size_t e = 0; e < unknowns.size(); ++e) {
    const Unknown& u = numbering_.unknown(static_cast<int>(e));
    if (!u.multiplier) motion[static_cast<std::size_t>(u.slot)] = unknowns[e];
  }
}

void MotionSlots::gather(std::span<const double> motion, std::span<double> unknowns) const {
  for (std::size_t e = 0; e < unknowns.size(); ++e) {
    const Unknown& u = numbering_.unknown(static_cast<int>(e));
    if (!u.multiplier) unknowns[e] = motion[static_cast<std::size_t>(u.slot)];
  }
}

std::vector<MotionSlots::Prescribed> MotionSlots::prescribed(double time) const {
  std::vector<Prescribed> all;
  for (const Support& s : model_.supports) {
    if (s.value == 0) continue;
    const Function::Jet f = s.function ? s.function->at(time) : Function::Jet{1, 0, 0, 0};
    all.push_back({static_cast<std::size_t>(6 * s.node + s.component), s.value * f.f, s.value * f.d1, s.value * f.d2});
  }
  return all;
}

void MotionSlots::prescribe_increment(double from, double to, std::span<double> y) const {
  const auto before = prescribed(from), after = prescribed(to);
  for (std::size_t i = 0; i < after.size(); ++i) y[after[i].slot] = after[i].u - before[i].u;
}

void MotionSlots::prescribe_rates(double time, std::span<double> v) const {
  for (const Prescribed& p : prescribed(time)) v[p.slot] = p.v;
}

void MotionSlots::prescribe_accelerations(double time, std::span<double> a) const {
  for (const Prescribed& p : prescribed(time)) a[p.slot] = p.a;
}

}  // namespace engrane::solve
