// SPDX-License-Identifier: BSD-3-Clause
// The memory of generalised-α: how it starts, and how it restarts.
#include <algorithm>
#include <cmath>

#include "solve/schemes/transient.hpp"

namespace engrane::solve {

namespace {

/// After an event the slope of v̇ is taken over this fraction of a step, so as not to reach the next event.
constexpr double slope_span = 0.01;
/// If the slopes of its two halves differ by more than this fraction of the larger one, a force jumps in one of them.
constexpr double unlike = 0.5;

}  // namespace

void Transient::start_memory(const Configuration& c, const MasslessMotions* massless) {
  const double h = context_.options.step;
  start_memory(c, h, h, massless);
}

void Transient::restart_memory(Configuration& c) {
  const double h = context_.options.step;
  const MasslessMotions* massless = massless_at(c);
  soften(c, h, massless);
  soften_signals(c, h);
  start_memory(c, h, slope_span * h, massless);
}

std::vector<double> Transient::slope_of_accelerations(const Configuration& c, double h, double span,
                                                      const MasslessMotions* massless) const {
  // From accelerations half a span and a span ahead, (4 a_½ − 3 a_0 − a_1)/span: of second order, since what glide() leaves out
  // of the velocities, four times as much at the end as halfway, cancels as well. Over a whole step it is also the slope for
  // models whose forces change much faster than a step is long.
  const auto after = [&](double time) {
    Configuration later = glide(c, time);
    if (span == h) settle_signals(later, c, time, h);  // as at the start itself
    context_.start.balance_accelerations(later, span < h ? 1 : 12, nullptr, massless);
    // also where `c` itself needs it not: speeds may excite what steps do not resolve, where nothing accelerates yet
    soften(later, h, massless);
    soften_signals(later, h);
    return context_.motion.accelerations(later);
  };
  std::vector<double> slope = context_.motion.accelerations(c), middle, end;
  try {
    middle = after(0.5 * span);
    end = after(span);
  } catch (const SolutionFailure&) {  // frictions that hold now need not hold then
    std::fill(slope.begin(), slope.end(), 0.0);
    return slope;
  }
  for (std::size_t i = 0; i < slope.size(); ++i) {
    const double first = 2 * (middle[i] - slope[i]) / span, second = 2 * (end[i] - middle[i]) / span;
    slope[i] = 1.5 * first - 0.5 * second;
    const bool jumps = span < h && std::abs(first - second) > unlike * std::max(std::abs(first), std::abs(second));
    if (jumps) slope[i] = std::abs(first) < std::abs(second) ? first : second;
  }
  return slope;
}

void Transient::start_memory(const Configuration& c, double h, double span, const MasslessMotions* massless) {
  algorithmic_ = context_.motion.accelerations(c);
  step_of_algorithmic_ = h;
  offset_.clear();
  accelerations_.clear();
  multipliers_.clear();
  fitting_ = context_.motion.velocities(c);
  const double shift = scheme_.alpha_m - scheme_.alpha_f;
  if (shift == 0 && !constrained()) return;  // nothing depends on the slope
  std::vector<double> slope = slope_of_accelerations(c, h, span, massless);
  // accelerations are differenced over the span, and accurate to a few digits less than they have
  constexpr double known = 1e-11;
  if (!counts(slope, h * h * h, algorithmic_, known / span)) std::fill(slope.begin(), slope.end(), 0.0);
  // a_0 = v̇(t_0 + (α_m − α_f) h) to second order, or multipliers lose an order at first (Arnold, Brüls and Cardona 2015)
  for (std::size_t i = 0; i < slope.size(); ++i) algorithmic_[i] += shift * h * slope[i];
  if (!constrained()) return;
  // With exact velocities and accelerations the increments of steps open the constraints by h³ B(c v̈ + W × Ẇ/12), the last
  // term for rotations. The scheme closes them by velocities that are off by that over h. If it begins without this error, the
  // first step makes it by accelerations, and so multipliers, that are off by O(h) (the same paper, section 5).
  const double c_3 = (1 - 3 * shift - 6 * scheme_.beta) / 6;
  std::vector<double> moved = fitting_;
  for (std::size_t i = 0; i < slope.size(); ++i) moved[i] += h * h * c_3 * slope[i];
  for (std::size_t n = 0; n < c.nodes.size(); ++n) {
    const Vec3 turn = c.nodes[n].W.cross(c.nodes[n].A) * (h * h / 12);
    for (Eigen::Index k = 0; k < 3; ++k) moved[6 * n + 3 + static_cast<std::size_t>(k)] += turn[k];
  }
  Configuration off = c;
  context_.motion.set_velocities(moved, off);
  offset_ = fitting_velocities(off);
  for (std::size_t i = 0; i < moved.size(); ++i) offset_[i] = moved[i] - offset_[i];
}

std::vector<double> Transient::renew_memory(const Configuration& from, double h) {
  Configuration c = from;
  if (constrained()) context_.motion.set_velocities(fitting_velocities(c), c);
  const MasslessMotions* massless = massless_at(c);
  context_.start.balance_accelerations(c, 3, nullptr, massless);
  const bool softened = soften(c, h, massless), signals = soften_signals(c, h);
  start_memory(c, h, slope_span * h, massless);
  return context_.motion.accelerations(softened || signals ? c : from);
}

std::vector<double> Transient::first_velocities(const Configuration& from, double h) {
  std::vector<double> v = context_.motion.velocities(from);
  const double ratio = h / step_of_algorithmic_;
  constexpr double same = 1e-6;  // lengths of steps that end at round times differ by rounding
  if (!constrained() || (offset_.empty() && std::abs(ratio - 1) < same)) return v;
  if (offset_.empty()) {
    fitting_ = fitting_velocities(from);
    offset_ = v;
    for (std::size_t i = 0; i < v.size(); ++i) offset_[i] -= fitting_[i];
  }
  if (!fitting_.empty()) v = fitting_;
  for (std::size_t i = 0; i < v.size(); ++i) v[i] += ratio * ratio * offset_[i];
  return v;
}

}  // namespace engrane::solve
