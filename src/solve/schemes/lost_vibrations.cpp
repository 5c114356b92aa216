// SPDX-License-Identifier: BSD-3-Clause
#include "solve/schemes/lost_vibrations.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "solve/algebra/imbalance.hpp"

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
/// Steps that say enough to be fitted with the third derivative of a slow motion beside ω and κ, and fits that say enough for the
/// vibration to be followed without one.
constexpr int enough_steps = 5;
/// What is left of a vibration may be found to be this many times as much as expected, or as little.
constexpr double near_expected = 2;
/// If more than this many times the expected amplitude is found, something has excited the vibration, or keeps it going; but
/// where it is below this part of its former amplitude, what is found is the slow motion.
constexpr double excited = 1.5, as_before = 0.6;
/// A vibration whose ω differs by more than this part is another one.
constexpr double another = 0.1;
/// Differences of accelerations below this fraction of their terms are rounding, or what iterations leave: so many times their
/// precision.
constexpr double least_noise = 1e-9, noise_of_iterations = 10;
/// Least part of the energy of a vibration that is found in displacements where nothing but their ratio to accelerations shows
/// its frequency. In short steps both are rounding, and what iterations leave of motions that are imposed.
constexpr double least_share = 1e-3;
/// Least part of the squares that a fit is taken to leave unexplained: it is known no better.
constexpr double least_unexplained = 1e-12;

}  // namespace

std::vector<LostVibrations::Pair> LostVibrations::joined(const Model& model) {
  std::vector<Pair> pairs;
  for (const Model::Part& part : model.parts) {
    if (part.nodes.size() != 2) continue;
    const auto [a, b] = std::minmax(part.nodes[0], part.nodes[1]);
    if (a > 0 && a < b) pairs.emplace_back(a, b);
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

LostVibrations::LostVibrations(const Collocation& collocation, double precision, double extent, std::size_t slots,
                               std::vector<Pair> pairs)
    : collocation_(collocation),
      noise_(std::max(least_noise, noise_of_iterations * precision)),
      extent_(extent),
      slots_(slots),
      pairs_(std::move(pairs)),
      weights_(),
      rounding_(slots),
      groups_(slots / 3 + 2 * pairs_.size()) {
  const std::array<double, 4> at{0, collocation.c[0], collocation.c[1], collocation.c[2]};
  for (std::size_t i = 0; i < at.size(); ++i) {
    weights_[i] = 1;
    for (std::size_t j = 0; j < at.size(); ++j)
      if (j != i) weights_[i] /= at[i] - at[j];
  }
  for (const double weight : weights_) sum_of_weights_ += std::abs(weight);
  for (std::vector<double>& difference : differences_) difference.assign(slots + 6 * pairs_.size(), 0.0);
}

void LostVibrations::append_relative(std::vector<double>& values) const {
  values.resize(slots_);
  for (const auto& [a, b] : pairs_)
    for (std::size_t k = 0; k < 6; ++k)
      values.push_back(values[6 * static_cast<std::size_t>(b) + k] - values[6 * static_cast<std::size_t>(a) + k]);
}

std::size_t LostVibrations::relative(int a, int b) const {
  if (a > b) std::swap(a, b);
  if (a == 0) return 6 * static_cast<std::size_t>(b);
  const auto found = std::lower_bound(pairs_.begin(), pairs_.end(), Pair{a, b});
  return slots_ + 6 * static_cast<std::size_t>(found - pairs_.begin());
}

void LostVibrations::look(std::span<const double> v0, std::span<const double> a0, Stages y, Stages v, Stages a) {
  auto& [of_y, of_v, of_a] = differences_;
  double largest = 0;
  for (std::size_t slot = 0; slot < slots_; ++slot) {
    of_y[slot] = 0;
    of_v[slot] = weights_[0] * v0[slot];
    of_a[slot] = weights_[0] * a0[slot];
    if (slot % 3 == 0) largest = largest_acceleration(slot / 3);
    // where forces nearly balance, iterations leave accelerations a part of what they have been
    double terms = std::max(std::abs(of_a[slot]), sum_of_weights_ * largest);
    for (std::size_t i = 0; i < y.size(); ++i) {
      of_y[slot] += weights_[i + 1] * y[i][slot];
      of_v[slot] += weights_[i + 1] * v[i][slot];
      of_a[slot] += weights_[i + 1] * a[i][slot];
      terms += std::abs(weights_[i + 1] * a[i][slot]);
    }
    const double left = negligible_correction * sum_of_weights_ * (slot % 6 < 3 ? extent_ : 1);
    rounding_[slot] = !(std::abs(of_a[slot]) > noise_ * terms) || !(std::abs(of_y[slot]) > left);
  }
  for (std::vector<double>& difference : differences_) append_relative(difference);
  for (std::size_t slot = 0; slot < slots_; ++slot)
    if (rounding_[slot]) of_y[slot] = of_v[slot] = of_a[slot] = 0;
}

double LostVibrations::largest_acceleration(std::size_t group) const {
  double most = 0;
  for (const Amplitude& one : groups_[group].amplitudes) most = std::max({most, one.largest, -one.least});
  return most;
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

void LostVibrations::Products::fade(double kept) {
  for (double* product : {&xx, &xv, &vv, &ax, &av, &aa}) *product *= kept;
}

void LostVibrations::Products::add(double x, double v, double a, double weight) {
  xx += weight * x * x, xv += weight * x * v, vv += weight * v * v;
  ax += weight * a * x, av += weight * a * v, aa += weight * a * a;
}

bool LostVibrations::solve(const Products& p, int steps, double h, bool slow_beside, Group& group) {
  if (!(p.xx > 0) || !(p.aa > 0)) return false;
  const double determinant = p.xx * p.vv - p.xv * p.xv;
  // two steps of one coordinate fit any ω and κ
  const bool tells_decay = steps > 2 && determinant > independent * p.xx * p.vv;
  // differences of a slow motion that only grow from step to step fit any equation
  if (slow_beside && !tells_decay) return false;
  double stiffness = -p.ax / p.xx, damping = 0;
  if (tells_decay) {
    stiffness = -(p.ax * p.vv - p.av * p.xv) / determinant;
    damping = -(p.av * p.xx - p.ax * p.xv) / determinant;
  }
  // one instant fits any frequency: of a vibration displacements and velocities tell the same, but for a phase that is rare
  if (!tells_decay && stiffness * p.xx < least_share * p.vv) return false;
  const double unexplained = p.aa + 2 * (stiffness * p.ax + damping * p.av) + stiffness * stiffness * p.xx +
                             2 * stiffness * damping * p.xv + damping * damping * p.vv;
  if (!(stiffness * h * h > resolved * resolved) || unexplained > (1 - good_fit) * p.aa) return false;
  const double rate = std::sqrt(stiffness);
  if (std::abs(rate - group.rate) > another * group.rate) group.certain = group.decays = 0;
  group.rate = rate;
  // the first fits, of short steps, are the best: later ones, to which the slow motion adds, must not outweigh them
  if (tells_decay) {
    const double certain = determinant / (p.xx * std::max(unexplained, least_unexplained * p.aa));
    group.certain += certain;
    group.decays += 0.5 * damping * certain;
  }
  group.decay = group.certain > 0 ? std::max(group.decays / group.certain, 0.0) : 0;
  return true;
}

bool LostVibrations::fit(Group& group, std::size_t first, double h, bool fresh) const {
  if (fresh) group.fit = {};
  Fit& f = group.fit;
  const double cube = h * h * h;
  f.products.fade(memory_of_fit);
  f.slow_square = memory_of_fit * f.slow_square + cube * cube;
  ++f.steps;
  for (std::size_t k = 0; k < 3; ++k) {
    f.products.add(differences_[0][first + k], differences_[1][first + k], differences_[2][first + k]);
    for (std::size_t i = 0; i < 3; ++i) f.slow[k][i] = memory_of_fit * f.slow[k][i] + cube * differences_[i][first + k];
  }
  bool found = solve(f.products, f.steps, h, false, group);
  if (!found && f.steps >= enough_steps) {
    Products fast = f.products;
    for (const auto& [x, v, a] : f.slow) fast.add(x, v, a, -1 / f.slow_square);
    found = solve(fast, f.steps, h, true, group);
  }
  if (found) ++f.good;
  return found;
}

double LostVibrations::amplitude(const Group& group, std::size_t slot, const Effect& effect, bool found) const {
  const Amplitude& one = group.amplitudes[slot % 3];
  const double rates = std::hypot(group.rate * differences_[0][slot], differences_[1][slot]);
  const double shown = group.rate * rates / effect.difference;
  const double here = std::min(shown, 0.5 * (one.largest - one.least));
  const bool follows =
      group.fit.good >= enough_steps && here < near_expected * one.expected && near_expected * here > one.expected;
  if (!found && !follows) return 0;
  return here > excited * one.expected && here <= as_before * one.whole ? 0 : here;
}

void LostVibrations::Amplitude::include(double velocity, double acceleration, bool first) {
  least = first ? acceleration : std::min(least, acceleration);
  largest = first ? acceleration : std::max(largest, acceleration);
  lowest = first ? velocity : std::min(lowest, velocity);
  highest = first ? velocity : std::max(highest, velocity);
}

void LostVibrations::Amplitude::step(double amplitude, double decayed, const Effect& effect, double h) {
  if (amplitude > excited * expected) whole = lost = 0;
  expected = effect.factor * (amplitude > 0 ? amplitude : expected);
  if (amplitude > 0)
    left = memory_of_amplitude * left + (1 - memory_of_amplitude) * amplitude * amplitude;
  else
    left *= effect.factor * effect.factor;
  const double now = std::sqrt(left);
  whole = std::max(decayed * whole, now);
  lost = std::min(decayed * lost + effect.error * amplitude, whole);
  const double missing = std::min(lost, whole - now);
  if (missing > counts * whole) square += 0.5 * missing * missing * h;
}

void LostVibrations::take(double h, bool first, std::span<const double> velocities, std::span<const double> accelerations,
                          std::span<const double> inertia) {
  std::vector<double> v(velocities.begin(), velocities.end()), a(accelerations.begin(), accelerations.end());
  append_relative(v);
  append_relative(a);
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    Group& group = groups_[g];
    const bool found = fit(group, 3 * g, h, first);
    const Effect step = group.rate > 0 ? effect(group.rate * h, group.decay * h) : Effect{0, 1, 0};
    const double decayed = std::exp(-group.decay * h);
    for (std::size_t slot = 3 * g; slot < 3 * g + 3; ++slot) {
      if (found && slot < inertia.size()) {
        group.accelerations += differences_[2][slot] * differences_[2][slot];
        group.forces += inertia[slot] * inertia[slot];
      }
      Amplitude& one = group.amplitudes[slot % 3];
      one.include(v[slot], a[slot], time_ == 0);
      if (!(group.rate > 0)) continue;
      const double here = amplitude(group, slot, step, found);
      if (step.error * here > group.most_lost) {
        group.most_lost = step.error * here;
        group.lost_rate = group.rate;
      }
      one.step(here, decayed, step, h);
    }
  }
  time_ += h;
}

double LostVibrations::period(std::size_t slot) const {
  const double rate = groups_[slot / 3].lost_rate;
  return rate > 0 ? 2 * std::numbers::pi / rate : 0;
}

std::vector<double> LostVibrations::periods() const {
  std::vector<double> all;
  for (std::size_t slot = 0; slot < 3 * groups_.size(); slot += 3) all.push_back(period(slot));
  return all;
}

double LostVibrations::missing_speed(std::size_t slot) const {
  const double rate = groups_[slot / 3].lost_rate;
  return rate > 0 ? missing(slot) / rate : 0;
}

double LostVibrations::range_of_speed(std::size_t slot) const {
  const Amplitude& one = groups_[slot / 3].amplitudes[slot % 3];
  return one.highest - one.lowest;
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
