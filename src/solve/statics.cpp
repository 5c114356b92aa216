// SPDX-License-Identifier: BSD-3-Clause
#include "solve/statics.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "solve/blame.hpp"

namespace engrane {

Statics::Statics(Workbench& bench)
    : Analysis(bench), has_contacts_(std::any_of(bench.model.parts.begin(), bench.model.parts.end(), [](const Model::Part& part) {
        return !part.element->layout().switches.empty();
      })) {
  *unknowns_.out() = bench.assembler.new_vector();
}

StartReport Statics::start(Configuration& c) {
  StartReport report;
  apply_initial_displacements(bench_, c);
  bench_.start.assemble(c, report);
  bench_.assembler.choose_scale(c, {1, 0, 0}, bench_.model.commands.analysis.scale.value_or(0));
  Configuration balanced = c;
  const NewtonReport newton = attempt(c, 0, balanced);
  if (!newton.converged) {
    std::string why = fmt::format("no equilibrium at the start, t = {:.6g}: {}", c.time, newton.reason);
    if (newton.conflict) throw SolutionFailure(why);
    if (newton.singular) throw SolutionFailure(explain_singular(bench_.assembler, why));
    why += "; " + explain_residual(bench_.assembler, balanced, newton);
    throw SolutionFailure(why + ". Loads given without NF act in full from the start: ramp them with a function of time");
  }
  c = std::move(balanced);
  return report;
}

NewtonReport Statics::attempt(const Configuration& from, double h, Configuration& to) {
  std::vector<double> y(bench_.motion.size(), 0.0);
  prescribe_step(from.time, from.time + h, y);
  const std::vector<double> prescribed = y;
  to = from;
  to.time = from.time + h;
  NewtonReport report = balance(from, y, to);
  if (!report.converged && has_contacts_) {
    Configuration other = from;
    other.time = to.time;
    if (NewtonReport across = balance_across_gaps(from, prescribed, other); across.converged) {
      to = std::move(other);
      return across;
    }
  }
  return report;
}

NewtonReport Statics::balance(const Configuration& from, std::span<double> y, Configuration& to) {
  const Newton::Apply apply = [&](std::span<const double> unknowns, Configuration& c) {
    bench_.motion.scatter(unknowns, y);
    bench_.motion.move(from, y, c);
    unknowns_to_multipliers(unknowns, c);
  };
  std::vector<double> guess(static_cast<std::size_t>(bench_.numbering.equations()), 0.0);
  bench_.motion.gather(y, guess);
  multipliers_to_unknowns(to, guess);
  bench_.assembler.spread(guess, unknowns_);
  NewtonReport report = solve(unknowns_, {1, 0, 0}, apply, to);
  refuse_half_turns(y, report);
  return report;
}

NewtonReport Statics::balance_across_gaps(const Configuration& from, std::span<const double> prescribed, Configuration& to) {
  std::vector<double> y(prescribed.begin(), prescribed.end());
  NewtonReport report;
  int iterations = 0;
  for (const double bridge : {1.0, 0.1, 0.01, 1e-3, 1e-4, 1e-5, 1e-6, 0.0}) {
    bench_.assembler.bridge = bridge;
    try {
      report = balance(from, y, to);
    } catch (...) {
      bench_.assembler.bridge = 0;
      throw;
    }
    iterations += report.iterations;
    if (!report.converged) break;
  }
  bench_.assembler.bridge = 0;
  report.iterations = iterations;
  return report;
}

}  // namespace engrane
