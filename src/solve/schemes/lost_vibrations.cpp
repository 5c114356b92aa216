// SPDX-License-Identifier: BSD-3-Clause
#include "solve/schemes/lost_vibrations.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace engrane::solve {

namespace {

/// Weight of the steps before in fits, and in the amplitude that is left.
constexpr double memory_of_fit = 0.8, memory_of_amplitude = 0.5;
/// Part of the differences of accelerations, by squares, that a vibration explains.
constexpr double good_fit = 0.99;
/// Least independence of the differences of velocities and displacements for κ to be found too.
constexpr double independent = 1e-2;
/// Steps over 1/ω below which nothing is lost: 9e-9 of an amplitude in a step.
constexpr double resolved = 0.2;
/// Part of a vibration that must be missing to count: of less, the difference of two runs shows enough, and a resonance that
/// was passed leaves as much.
constexpr double counts = 0.4;

}  // namespace

LostVibrations::LostVibrations(const Collocation& collocation, std::size_t slots)
    : collocation_(collocation), weights_(), groups_(slots / 3) {
  const std::array<double, 4> at{0, collocation.c[0], collocation.c[1], collocation.c[2]};
  for (std::size_t i = 0; i < at.size(); ++i) {
    weights_[i] = 1;
    for (std::size_t j = 0; j < at.size(); ++j)
      if (j != i) weights_[i] /= at[i] - at[j];
  }
  for (std::vector<double>& difference : differences_) difference.assign(slots, 0.0);
}

void LostVibrations::look(std::span<const double> v0, std::span<const double> a0, Stages y, Stages v, Stages a) {
  auto& [of_y, of_v, of_a] = differences_;
  for (std::size_t slot = 0; slot < of_y.size(); ++slot) {
    of_y[slot] = 0;
    of_v[slot] = weights_[0] * v0[slot];
    of_a[slot] = weights_[0] * a0[slot];
    for (std::size_t i = 0; i < y.size(); ++i) {
      of_y[slot] += weights_[i + 1] * y[i][slot];
      of_v[slot] += weights_[i + 1] * v[i][slot];
      of_a[slot] += weights_[i + 1] * a[i][slot];
    }
  }
}

LostVibrations::Effect LostVibrations::effect(double omega_h, double kappa_h) const {
  using Complex = std::complex<double>;
  // increments Y of ẋ = zx/h from x = 1: Y = z a (1 + Y)
  const auto increments = [&](Complex z) -> Eigen::Vector3cd {
    const Eigen::Matrix3cd a = collocation_.a.cast<Complex>();
    return (Eigen::Matrix3cd::Identity() - z * a).partialPivLu().solve(z * collocation_.c.cast<Complex>());
  };
  const Eigen::Vector3cd undamped = increments({0, omega_h});
  Complex difference = 0;
  for (Eigen::Index i = 0; i < 3; ++i) difference += weights_[static_cast<std::size_t>(i + 1)] * undamped[i];
  const Complex z(-kappa_h, omega_h), end = 1.0 + increments(z)[2];
  return {std::abs(difference), std::abs(end), std::abs(end - std::exp(z))};
}

bool LostVibrations::fit(Group& group, std::size_t first, double h, bool fresh) const {
  Fit& f = group.fit;
  const double kept = fresh ? 0 : memory_of_fit;
  f = {kept * f.xx, kept * f.xv, kept * f.vv, kept * f.ax, kept * f.av, kept * f.aa};
  for (std::size_t slot = first; slot < first + 3; ++slot) {
    const double x = differences_[0][slot], v = differences_[1][slot], a = differences_[2][slot];
    f.xx += x * x, f.xv += x * v, f.vv += v * v;
    f.ax += a * x, f.av += a * v, f.aa += a * a;
  }
  if (!(f.xx > 0) || !(f.aa > 0)) return false;
  const double determinant = f.xx * f.vv - f.xv * f.xv;
  double stiffness = -f.ax / f.xx, damping = 0;
  if (determinant > independent * f.xx * f.vv) {
    stiffness = -(f.ax * f.vv - f.av * f.xv) / determinant;
    damping = -(f.av * f.xx - f.ax * f.xv) / determinant;
  }
  const double unexplained = f.aa + 2 * (stiffness * f.ax + damping * f.av) + stiffness * stiffness * f.xx +
                             2 * stiffness * damping * f.xv + damping * damping * f.vv;
  if (!(stiffness * h * h > resolved * resolved) || unexplained > (1 - good_fit) * f.aa) return false;
  group.rate = std::sqrt(stiffness);
  group.decay = std::max(0.5 * damping, 0.0);
  return true;
}

void LostVibrations::take(double h, bool first, std::span<const double> accelerations, std::span<const double> inertia) {
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    Group& group = groups_[g];
    const bool found = fit(group, 3 * g, h, first);
    const Effect step = group.rate > 0 ? effect(group.rate * h, group.decay * h) : Effect{0, 1, 0};
    const double decayed = std::exp(-group.decay * h);
    for (std::size_t slot = 3 * g; found && !inertia.empty() && slot < 3 * g + 3; ++slot) {
      group.accelerations += differences_[2][slot] * differences_[2][slot];
      group.forces += inertia[slot] * inertia[slot];
    }
    for (std::size_t k = 0; k < 3; ++k) {
      Amplitude& one = group.amplitudes[k];
      const std::size_t slot = 3 * g + k;
      one.least = time_ > 0 ? std::min(one.least, accelerations[slot]) : accelerations[slot];
      one.largest = time_ > 0 ? std::max(one.largest, accelerations[slot]) : accelerations[slot];
      if (!(group.rate > 0)) continue;
      double amplitude = 0;
      if (found) {
        const double rates = std::hypot(group.rate * differences_[0][slot], differences_[1][slot]);
        amplitude = std::min(group.rate * rates / step.difference, 0.5 * (one.largest - one.least));
        if (step.error * amplitude > group.most_lost) {
          group.most_lost = step.error * amplitude;
          group.lost_rate = group.rate;
        }
        one.left = memory_of_amplitude * one.left + (1 - memory_of_amplitude) * amplitude * amplitude;
      } else {
        one.left *= step.factor * step.factor;
      }
      const double left = std::sqrt(one.left);
      one.whole = std::max(decayed * one.whole, left);
      one.lost = std::min(decayed * one.lost + step.error * amplitude, one.whole);
      const double missing = std::min(one.lost, one.whole - left);
      if (missing > counts * one.whole) one.square += 0.5 * missing * missing * h;
    }
  }
  time_ += h;
}

double LostVibrations::period(std::size_t slot) const {
  const double rate = groups_[slot / 3].lost_rate;
  return rate > 0 ? 2 * std::numbers::pi / rate : 0;
}

double LostVibrations::missing_force(std::size_t first_slot) const {
  const Group& group = groups_[first_slot / 3];
  if (!(group.accelerations > 0)) return 0;
  const double missing_here = std::hypot(missing(first_slot), missing(first_slot + 1), missing(first_slot + 2));
  return missing_here * std::sqrt(group.forces / group.accelerations);
}

double LostVibrations::missing(std::size_t slot) const {
  return time_ > 0 ? std::sqrt(groups_[slot / 3].amplitudes[slot % 3].square / time_) : 0;
}

}  // namespace engrane::solve
