// SPDX-License-Identifier: BSD-3-Clause
// The start of a transient: positions, velocities and accelerations that fit, of what has mass and of what has none.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "solve/constraints/constraint_factors.hpp"
#include "solve/constraints/diagnosis.hpp"
#include "solve/schemes/statics.hpp"
#include "solve/schemes/transient.hpp"

namespace engrane::solve {

namespace {

/// After an event the slope of v̇ is taken over this part of a step, so as not to reach the next event.
constexpr double slope_span = 0.01;
constexpr double rounding = 64 * std::numeric_limits<double>::epsilon();

}  // namespace

StartReport Transient::start(Configuration& c) {
  StartReport report;
  if (context_.options.static_start) {
    report = Statics(context_).start(c);
  } else {
    apply_initial_displacements(context_, c);
    context_.start.assemble(c, report);
  }
  apply_initial_velocities(context_, c);
  context_.start.fit_velocities(c, Assembler::Metric::mass, report);
  MasslessMotions massless(context_.assembler, c);
  has_massless_ = massless.any();
  if (context_.grips.any()) {
    context_.grips.settle(c, has_massless_);
    massless = MasslessMotions(context_.assembler, c);
  }
  if (has_massless_)
    settle(c, massless, report);
  else
    context_.start.balance_accelerations(c, 12, &report);
  const double h = context_.options.step;
  start_memory(c, h, h, has_massless_ ? &massless : nullptr);
  return report;
}

void Transient::restart_memory(const Configuration& c) {
  const double h = context_.options.step;
  start_memory(c, h, slope_span * h, massless_at(c));
}

std::vector<double> Transient::slope_of_accelerations(const Configuration& c, double span, int iterations,
                                                      const MasslessMotions* massless) const {
  // From accelerations half a span and a span ahead, (4 a_½ − 3 a_0 − a_1)/span: of second order, since what glide() leaves out
  // of the velocities, four times as much at the end as halfway, cancels as well. Over a whole step it is also that of models
  // whose forces change much faster than a step is long.
  std::vector<double> slope = context_.motion.accelerations(c);
  for (double& s : slope) s *= -3;
  for (const auto& [part, weight] : {std::pair{0.5, 4.0}, std::pair{1.0, -1.0}}) {
    Configuration later = glide(c, part * span);
    context_.start.balance_accelerations(later, iterations, nullptr, massless);
    const auto then = context_.motion.accelerations(later);
    for (std::size_t i = 0; i < slope.size(); ++i) slope[i] += weight * then[i];
  }
  for (double& s : slope) s /= span;
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
  if (shift == 0 && !constrained()) return;  // nothing follows from the slope
  std::vector<double> slope = slope_of_accelerations(c, span, span < h ? 1 : 12, massless);
  // accelerations are differenced over the span, and found to a few digits less than they have
  constexpr double known = 1e-11;
  if (!counts(slope, h * h * h, algorithmic_, known / span)) std::fill(slope.begin(), slope.end(), 0.0);
  // a_0 = v̇(t_0 + (α_m − α_f) h) to second order, or multipliers lose an order at first (Arnold, Brüls and Cardona 2015)
  for (std::size_t i = 0; i < slope.size(); ++i) algorithmic_[i] += shift * h * slope[i];
  if (!constrained()) return;
  // The increments of steps with exact velocities and accelerations open the constraints by h³ B(c v̈ + W × Ẇ/12), the last for
  // rotations. The scheme closes them by velocities that are off by as much over h; one that begins without this error finds it
  // in the first step by accelerations, and so multipliers, that are off by a part of h (the same paper, section 5).
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

std::vector<double> Transient::fitting_velocities(const Configuration& c) const {
  std::vector<double> v = context_.motion.velocities(c);
  Configuration fitted = c;
  StartReport unused;
  try {
    context_.start.fit_velocities(fitted, Assembler::Metric::mass, unused, false);
  } catch (const SolutionFailure&) {
    return v;  // the step itself finds the conflict, and says when
  }
  std::vector<double> fit = context_.motion.velocities(fitted), change = fit;
  for (std::size_t i = 0; i < v.size(); ++i) change[i] -= v[i];
  return counts(change, context_.options.step, v, rounding) ? fit : v;
}

void Transient::renew_memory(const Configuration& from, double h) {
  Configuration c = from;
  if (constrained()) context_.motion.set_velocities(fitting_velocities(c), c);
  const MasslessMotions* massless = massless_at(c);
  context_.start.balance_accelerations(c, 3, nullptr, massless);
  start_memory(c, h, slope_span * h, massless);
}

std::vector<double> Transient::first_velocities(const Configuration& from, double h) {
  std::vector<double> v = context_.motion.velocities(from);
  const double ratio = h / step_of_algorithmic_;
  constexpr double same = 1e-6;  // ends of steps at round times make them differ by rounding
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

bool Transient::counts(std::span<const double> changes, double scale, std::span<const double> rates, double share) const {
  const double extent = context_.model.extent();
  Magnitudes change, rate;
  for (const Unknown& u : context_.numbering.unknowns()) {
    if (u.multiplier) continue;
    const auto slot = static_cast<std::size_t>(u.slot);
    const double size = std::abs(changes[slot]);
    if (size * scale > rounding * size_of(u, extent)) return true;
    change[u.measure] = std::max(change[u.measure], size);
    rate[u.measure] = std::max(rate[u.measure], std::abs(rates[slot]));
  }
  for (int m = 0; m < 4; ++m)
    if (rate.of[m] > 0 && change.of[m] > share * rate.of[m]) return true;
  return false;
}

bool Transient::constrained() const { return context_.numbering.slots() > context_.numbering.motion_slots(); }

Transient::Relaxed Transient::relax(Configuration& c, MasslessMotions& massless) {
  // An implicit Euler step so short that masses hardly move. Springs go to where they balance, however short it is; a damper's
  // displacement is the step times what its velocity lacks, and a second step from where the first one ended has that again,
  // while springs then rest: so the two are told apart.
  const double tau = 1e-3 * context_.options.step;
  const Weights weights{1, 1 / tau, 1 / (tau * tau)};
  context_.assembler.choose_scale(c, weights, context_.options.scale);
  scaled_for_ = 0;
  const std::size_t n = context_.motion.size();
  const auto v0 = context_.motion.velocities(c), a0 = context_.motion.accelerations(c);
  std::vector<double> first(n, 0.0), y(n, 0.0), v(n), a(n);
  for (const bool again : {false, true}) {
    const Configuration from = outside_of_steps(c);
    Configuration to = from;
    const Newton::Apply apply = [&](std::span<const double> unknowns, Configuration& tried) {
      context_.motion.scatter(unknowns, y);
      for (std::size_t i = 0; i < n; ++i) {
        v[i] = v0[i] + y[i] / tau;
        a[i] = a0[i] + y[i] / (tau * tau);
      }
      context_.motion.move(from, y, tried);
      context_.motion.set_velocities(v, tried);
      context_.motion.set_accelerations(a, tried);
      unknowns_to_multipliers(unknowns, tried);
    };
    std::vector<double> guess(static_cast<std::size_t>(context_.numbering.equations()), 0.0);
    multipliers_to_unknowns(from, guess);
    context_.assembler.spread(guess, unknowns_);
    const NewtonReport newton = solve(unknowns_, weights, apply, to);
    if (!newton.converged)
      throw SolutionFailure(fmt::format("no balance at t = {:.6g} of what has no mass, such as {}: {}; {}", c.time,
                                        massless.example(), newton.reason, explain_residual(context_.assembler, to, newton)));
    c = outside_of_steps(std::move(to));
    context_.motion.set_velocities(v0, c);
    context_.motion.set_accelerations(a0, c);
    if (!again) std::swap(first, y);
    if (!again) y.assign(n, 0.0);
  }
  // the second step taken back, twice: all but the springs then is where it was
  Relaxed relaxed{std::move(first), y};
  const Configuration moved = c;
  for (std::size_t i = 0; i < n; ++i) {
    relaxed.jump[i] -= y[i];
    relaxed.speed[i] /= tau;
    y[i] *= -2;
  }
  context_.motion.move(moved, y, c);
  c = outside_of_steps(std::move(c));
  massless = MasslessMotions(context_.assembler, c);
  massless.keep(relaxed.jump);
  massless.keep(relaxed.speed);
  return relaxed;
}

void Transient::settle(Configuration& c, MasslessMotions& massless, StartReport& report) {
  constexpr int most_passes = 10;
  const std::size_t n = context_.motion.size();
  report.massless = massless.count();
  report.massless_example = massless.example();
  if (const std::string unheld = massless.explain_unheld(context_.assembler, c); !unheld.empty()) throw SolutionFailure(unheld);
  // positions; velocities where dampers ask for them, each pass nearer by the length of its step over their time of decay
  auto v = context_.motion.velocities(c);
  for (int pass = 0; pass < most_passes; ++pass) {
    const Relaxed relaxed = relax(c, massless);
    double change = 0, size = 0;
    for (std::size_t i = 0; i < n; ++i) {
      v[i] += relaxed.speed[i];
      change = std::max(change, std::abs(relaxed.speed[i]));
      size = std::max(size, std::abs(v[i]));
    }
    context_.motion.set_velocities(v, c);
    if (change <= 1e-12 * size) break;
  }
  context_.start.balance_accelerations(c, 12, &report, &massless);
  // velocities of what springs hold follow from positions a little later, accelerations of all from velocities then
  const double later = 0.01 * context_.options.step;
  Configuration once = glide(c, later), twice = glide(c, 2 * later);
  MasslessMotions then = massless;
  const Relaxed r1 = relax(once, then), r2 = relax(twice, then);
  auto a = context_.motion.accelerations(c);
  for (std::size_t i = 0; i < n; ++i) {
    v[i] += (4 * r1.jump[i] - r2.jump[i]) / (2 * later);
    a[i] += (r2.jump[i] - 2 * r1.jump[i]) / (later * later) + r1.speed[i] / later;
  }
  context_.motion.set_velocities(v, c);
  context_.motion.set_accelerations(a, c);
  context_.start.balance_accelerations(c, 12, &report, &massless);
}

}  // namespace engrane::solve
