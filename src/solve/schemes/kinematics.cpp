// SPDX-License-Identifier: BSD-3-Clause
#include "solve/schemes/kinematics.hpp"

namespace engrane::solve {

StartReport Kinematics::start(Configuration& c) {
  StartReport report;
  apply_initial_displacements(context_, c);
  context_.start.assemble(c, report);
  apply_initial_velocities(context_, c);
  context_.start.fit_velocities(c, Assembler::Metric::geometric, report);
  context_.start.balance_accelerations(c, 12, &report);
  return report;
}

Outcome Kinematics::attempt(const Configuration& from, double h, Configuration& to) {
  Outcome outcome;
  NewtonReport& report = outcome.newton;
  to = from;
  to.time = from.time + h;
  to.h = h;
  // along the motion known so far: near enough to stay in the way the mechanism is assembled
  const auto v = context_.motion.velocities(from), a = context_.motion.accelerations(from);
  std::vector<double> y(context_.motion.size());
  for (std::size_t i = 0; i < y.size(); ++i) y[i] = h * (v[i] + 0.5 * h * a[i]);
  prescribe_step(from.time, to.time, y);
  context_.motion.move(from, y, to);
  report.converged = true;
  refuse_half_turns(y, report);
  if (!report.converged) return outcome;
  try {
    StartReport assembly;
    context_.start.assemble(to, assembly, false);
    context_.start.fit_velocities(to, Assembler::Metric::geometric, assembly, false);
    context_.start.balance_accelerations(to);
    report.iterations = assembly.position_iterations;
  } catch (const SolutionFailure& failure) {
    report.converged = false;
    report.conflict = true;
    report.reason = failure.what();
  }
  return outcome;
}

}  // namespace engrane::solve
