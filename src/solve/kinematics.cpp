// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kinematics.hpp"

namespace engrane {

StartReport Kinematics::start(Configuration& c) {
  StartReport report;
  apply_initial_displacements(bench_, c);
  bench_.start.assemble(c, report);
  apply_initial_velocities(bench_, c);
  bench_.start.fit_velocities(c, Assembler::Metric::geometric, report);
  bench_.start.balance_accelerations(c, 12, &report);
  return report;
}

NewtonReport Kinematics::attempt(const Configuration& from, double h, Configuration& to) {
  NewtonReport report;
  to = from;
  to.time = from.time + h;
  // along the motion known so far: near enough to stay in the way the mechanism is assembled
  const auto v = bench_.motion.velocities(from), a = bench_.motion.accelerations(from);
  std::vector<double> y(bench_.motion.size());
  for (std::size_t i = 0; i < y.size(); ++i) y[i] = h * (v[i] + 0.5 * h * a[i]);
  prescribe_step(from.time, to.time, y);
  bench_.motion.move(from, y, to);
  report.converged = true;
  refuse_half_turns(y, report);
  if (!report.converged) return report;
  try {
    StartReport assembly;
    bench_.start.assemble(to, assembly, false);
    bench_.start.fit_velocities(to, Assembler::Metric::geometric, assembly, false);
    bench_.start.balance_accelerations(to);
    report.iterations = assembly.position_iterations;
  } catch (const SolutionFailure& failure) {
    report.converged = false;
    report.conflict = true;
    report.reason = failure.what();
  }
  return report;
}

}  // namespace engrane
