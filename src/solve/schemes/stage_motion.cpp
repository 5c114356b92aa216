// SPDX-License-Identifier: BSD-3-Clause
#include "solve/schemes/stage_motion.hpp"

#include <algorithm>

#include "math/rotation.hpp"

namespace engrane::solve {

namespace {

Vec3 rotation_of(std::span<const double> slots, std::size_t node) {
  return {slots[6 * node + 3], slots[6 * node + 4], slots[6 * node + 5]};
}

void set_rotation(std::span<double> slots, std::size_t node, const Vec3& value) {
  for (std::size_t k = 0; k < 3; ++k) slots[6 * node + 3 + k] = value[static_cast<Eigen::Index>(k)];
}

/// `sum` += factor · values
void add(double factor, std::span<const double> values, std::span<double> sum) {
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += factor * values[i];
}

}  // namespace

StageMotion::StageMotion(const SolverContext& context, const Collocation& collocation)
    : context_(context), collocation_(collocation), prescribed_(static_cast<std::size_t>(collocation.stages())) {
  y.assign(prescribed_.size(), std::vector<double>(context.motion.size(), 0.0));
  v = a = y;
  multipliers.assign(prescribed_.size(), std::vector<double>(context.assembler.scale().size(), 0.0));
}

void StageMotion::begin(const Configuration& from, double h) {
  for (std::size_t i = 0; i < prescribed_.size(); ++i)
    prescribed_[i] = context_.motion.prescribed(from.time + collocation_.c[static_cast<Eigen::Index>(i)] * h);
}

void StageMotion::predict(const Configuration& from, double h, const Extrapolation& earlier_accelerations,
                          const Extrapolation& earlier_multipliers) {
  const auto stages = static_cast<std::size_t>(collocation_.stages());
  const auto v0 = context_.motion.velocities(from);
  for (std::size_t i = 0; i < stages; ++i) {
    const double time = from.time + h * collocation_.c[static_cast<Eigen::Index>(i)];
    earlier_accelerations.at(time, h, a[i]);
    earlier_multipliers.at(time, h, multipliers[i]);
  }
  for (std::size_t i = 0; i < stages; ++i) {
    v[i] = v0;
    for (std::size_t j = 0; j < stages; ++j)
      add(h * collocation_.a(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)), a[j], v[i]);
  }
  // rates of the rotation vectors follow from these and the angular velocities: ẏ = T(y)⁻¹ W
  std::vector<std::vector<double>> rates = v;
  for (int pass = 0; pass < 3; ++pass) {
    for (std::size_t i = 0; i < stages; ++i) {
      std::fill(y[i].begin(), y[i].end(), 0.0);
      for (std::size_t j = 0; j < stages; ++j)
        add(h * collocation_.a(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)), rates[j], y[i]);
    }
    for (std::size_t i = 0; i < stages; ++i)
      for (std::size_t n = 1; n < from.nodes.size(); ++n)
        if (const Vec3 turn = rotation_of(y[i], n); !turn.isZero(0))
          set_rotation(rates[i], n, rotation_tangent(turn).partialPivLu().solve(rotation_of(v[i], n)));
  }
}

void StageMotion::differentiate(const Configuration& from, double h) {
  const auto stages = static_cast<std::size_t>(collocation_.stages());
  const auto inverse = [&](std::size_t i, std::size_t j) {
    return collocation_.inverse(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  };
  const auto v0 = context_.motion.velocities(from);
  for (std::size_t i = 0; i < stages; ++i) {
    for (std::size_t slot = 0; slot < y[i].size(); ++slot)
      if (!has_equation(slot)) y[i][slot] = 0;
    context_.motion.prescribe_increment(from.time, from.time + h * collocation_.c[static_cast<Eigen::Index>(i)], y[i]);
  }
  for (std::size_t i = 0; i < stages; ++i) {
    std::vector<double>& rates = v[i];
    std::fill(rates.begin(), rates.end(), 0.0);
    for (std::size_t j = 0; j < stages; ++j) add(inverse(i, j) / h, y[j], rates);
    for (std::size_t n = 1; n < from.nodes.size(); ++n)
      if (const Vec3 turn = rotation_of(y[i], n); !turn.isZero(0))
        set_rotation(rates, n, rotation_tangent(turn) * rotation_of(rates, n));
    for (const auto& p : prescribed_[i]) rates[p.slot] = p.v;
  }
  for (std::size_t i = 0; i < stages; ++i) {
    std::vector<double>& rates = a[i];
    std::fill(rates.begin(), rates.end(), 0.0);
    for (std::size_t j = 0; j < stages; ++j)
      for (std::size_t slot = 0; slot < rates.size(); ++slot) rates[slot] += inverse(i, j) / h * (v[j][slot] - v0[slot]);
    for (std::size_t slot = 0; slot < rates.size(); ++slot)
      if (!has_equation(slot)) rates[slot] = 0;
    for (const auto& p : prescribed_[i]) rates[p.slot] = p.a;
  }
}

}  // namespace engrane::solve
