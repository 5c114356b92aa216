// SPDX-License-Identifier: BSD-3-Clause
// The start of dynamics: consistent positions, velocities and accelerations, with and without mass.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solve/constraints/constraint_factors.hpp"
#include "solve/constraints/diagnosis.hpp"
#include "solve/schemes/dynamics.hpp"
#include "solve/schemes/statics.hpp"

namespace engrane::solve {

StartReport Dynamics::start(Configuration& c) {
  StartReport report;
  if (context_.options.static_start) {
    report = Statics(context_).start(c);
  } else {
    apply_initial_displacements(context_, c);
    context_.start.assemble(c, report);
  }
  c = at_start_of_step(std::move(c));  // rates are not those of the turn that led here
  apply_initial_velocities(context_, c);
  context_.start.fit_velocities(c, Assembler::Metric::mass, report);
  MasslessMotions massless(context_.assembler, c);
  has_massless_ = massless.any();
  if (context_.grips.any()) {
    context_.grips.settle(c, massless.any());
    massless = MasslessMotions(context_.assembler, c);
  }
  if (*has_massless_)
    settle(c, massless, report);
  else
    context_.start.balance_accelerations(c, 12, &report);
  const MasslessMotions* none = *has_massless_ ? &massless : nullptr;
  // a rate that sets in here is what their first step would make a jump of; a second time with what that changes of accelerations
  if (context_.options.family != SolverOptions::Family::radau)
    for (int pass = 0; pass < 2 && settle_signals(c, c, 0, context_.options.step); ++pass)
      context_.start.balance_accelerations(c, 12, &report, none);
  soften(c, context_.options.step, none, &report);
  soften_signals(c, context_.options.step);
  start_memory(c, none);
  return report;
}

bool Dynamics::soften(Configuration& c, double h, const MasslessMotions* massless, StartReport* report) const {
  return !error_.wanted() && context_.start.soften(c, h, report, massless);
}

bool Dynamics::soften_signals(Configuration& c, double h) const {
  return !error_.wanted() && context_.start.soften_signals(c, h);
}

bool Dynamics::settle_signals(Configuration& c, const Configuration& from, double after, double h) const {
  const double span = 0.01 * h;
  return !error_.wanted() && context_.start.settle_signals(c, glide(from, after + span), span, h);
}

Dynamics::Relaxed Dynamics::relax(Configuration& c, MasslessMotions& massless) {
  // An implicit Euler step so short that masses hardly move. Springs go to where they balance, however short it is. A damper
  // moves by the step times what its velocity lacks, and does so again in a second step from the end of the first, while
  // springs then rest: this tells the two apart.
  const double tau = 1e-3 * context_.options.step;
  const Weights weights{1, 1 / tau, 1 / (tau * tau)};
  context_.assembler.choose_scale(c, weights, context_.options.scale);
  scaled_for_ = 0;
  const std::size_t n = context_.motion.size();
  const auto v0 = context_.motion.velocities(c), a0 = context_.motion.accelerations(c);
  std::vector<double> first(n, 0.0), y(n, 0.0), v(n), a(n);
  for (const bool again : {false, true}) {
    const Configuration from = at_start_of_step(c);
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
      context_.assembler.unknowns_to_multipliers(unknowns, tried);
    };
    std::vector<double> guess(static_cast<std::size_t>(context_.numbering.equations()), 0.0);
    context_.assembler.multipliers_to_unknowns(from, guess);
    context_.assembler.spread(guess, unknowns_);
    const NewtonReport newton = solve(unknowns_, weights, apply, to);
    if (!newton.converged)
      throw SolutionFailure(fmt::format("no balance at t = {:.6g} of what has no mass, such as {}: {}; {}", c.time,
                                        massless.example(), newton.reason, explain_residual(context_.assembler, to, newton)));
    c = at_start_of_step(std::move(to));
    context_.motion.set_velocities(v0, c);
    context_.motion.set_accelerations(a0, c);
    if (!again) std::swap(first, y);
    if (!again) y.assign(n, 0.0);
  }
  // the second step taken back twice: everything but the springs is then where it was
  Relaxed relaxed{std::move(first), y};
  const Configuration moved = c;
  for (std::size_t i = 0; i < n; ++i) {
    relaxed.jump[i] -= y[i];
    relaxed.speed[i] /= tau;
    y[i] *= -2;
  }
  context_.motion.move(moved, y, c);
  c = at_start_of_step(std::move(c));
  massless = MasslessMotions(context_.assembler, c);
  massless.keep(relaxed.jump);
  massless.keep(relaxed.speed);
  return relaxed;
}

void Dynamics::settle(Configuration& c, MasslessMotions& massless, StartReport& report) {
  constexpr int most_passes = 10;
  const std::size_t n = context_.motion.size();
  report.massless = massless.count();
  report.massless_example = massless.example();
  if (const std::string unheld = massless.explain_unheld(context_.assembler, c); !unheld.empty()) throw SolutionFailure(unheld);
  // positions, and velocities where dampers determine them; each pass reduces their error by its step over their decay time
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
  // velocities of what springs hold follow from positions a little later, accelerations of everything from velocities then
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
