// SPDX-License-Identifier: BSD-3-Clause
#include "solve/statics.hpp"

#include <fmt/format.h>

#include "solve/blame.hpp"

namespace engrane {

Statics::Statics(Workbench& bench) : Analysis(bench) { *unknowns_.out() = bench.assembler.new_vector(); }

StartReport Statics::start(Configuration& c) {
  StartReport report;
  apply_initial_displacements(c);
  bench_.start.assemble(c, report);
  bench_.assembler.choose_scale(c, {1, 0, 0}, bench_.model.commands.analysis.scale.value_or(0));
  Configuration balanced = c;
  const NewtonReport newton = attempt(c, 0, balanced);
  if (!newton.converged) {
    std::string why = fmt::format("no equilibrium at the start, t = {:.6g}: {}", c.time, newton.reason);
    if (newton.singular)
      why = explain_singular(bench_.assembler, why);
    else
      why += "; " + explain_residual(bench_.assembler, balanced, newton);
    throw SolutionFailure(why + ". Loads given without NF act in full from the start: ramp them with a function of time");
  }
  c = std::move(balanced);
  return report;
}

NewtonReport Statics::attempt(const Configuration& from, double h, Configuration& to) {
  const double time = from.time + h;
  std::vector<double> y(bench_.motion.size(), 0.0);
  prescribe_step(from.time, time, y);
  to = from;
  to.time = time;
  const Newton::Apply apply = [&](std::span<const double> unknowns, Configuration& c) {
    bench_.motion.scatter(unknowns, y);
    bench_.motion.move(from, y, c);
    unknowns_to_multipliers(unknowns, c);
  };
  std::vector<double> guess(static_cast<std::size_t>(bench_.numbering.equations()), 0.0);
  multipliers_to_unknowns(from, guess);
  bench_.assembler.spread(guess, unknowns_);
  NewtonReport report = bench_.newton.solve(unknowns_, {1, 0, 0}, apply, to);
  refuse_half_turns(y, report);
  return report;
}

}  // namespace engrane
