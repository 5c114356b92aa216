// SPDX-License-Identifier: BSD-3-Clause
#include "solve/schemes/statics.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "solve/constraints/diagnosis.hpp"

namespace engrane::solve {

namespace {

/// Whether forces are linear in the displacements: cells with small ones, and loads that depend on time alone.
bool is_linear(const Model& model) {
  const auto linear = [](const Model::Part& part) {
    const bool dead = part.type == "ARETE" || (part.type == "CHA" && !part.element->layout().needs_any(0, NodeNeed::rotation));
    return dead || part.element->cell_shape() != CellShape::none;
  };
  return model.commands.analysis.displacements.is("SMALL") && std::all_of(model.parts.begin(), model.parts.end(), linear);
}

}  // namespace

Statics::Statics(SolverContext& context)
    : Scheme(context),
      has_contacts_(std::any_of(context.model.parts.begin(), context.model.parts.end(),
                                [](const Model::Part& part) { return !part.element->layout().switches.empty(); })) {
  *unknowns_.out() = context.assembler.new_vector();
  if (is_linear(context_.model)) context_.newton.keep_one_tangent();
}

StartReport Statics::start(Configuration& c) {
  StartReport report;
  apply_initial_displacements(context_, c);
  context_.start.assemble(c, report);
  context_.assembler.choose_scale(c, {1, 0, 0}, context_.options.scale);
  Configuration balanced = c;
  const NewtonReport newton = attempt(c, 0, balanced).newton;
  if (!newton.converged) {
    std::string why = fmt::format("no equilibrium at the start, t = {:.6g}: {}", c.time, newton.reason);
    if (newton.conflict) throw SolutionFailure(why);
    if (newton.singular) throw SolutionFailure(explain_singular(context_.assembler, why, Resistance::at_rest));
    why += "; " + explain_residual(context_.assembler, balanced, newton);
    throw SolutionFailure(why + ". Loads given without NF act in full from the start: ramp them with a function of time");
  }
  c = std::move(balanced);
  return report;
}

Outcome Statics::attempt(const Configuration& from, double h, Configuration& to) {
  std::vector<double> y(context_.motion.size(), 0.0);
  prescribe_step(from.time, from.time + h, y);
  const std::vector<double> prescribed = y;
  to = from;
  to.time = from.time + h;
  to.h = h;
  NewtonReport report = balance(from, y, to);
  if (!report.converged && has_contacts_) {
    Configuration other = from;
    other.time = to.time;
    if (NewtonReport across = balance_across_gaps(from, prescribed, other); across.converged) {
      to = std::move(other);
      return {std::move(across), {}};
    }
  }
  return {std::move(report), {}};
}

NewtonReport Statics::balance(const Configuration& from, std::span<double> y, Configuration& to) {
  const Newton::Apply apply = [&](std::span<const double> unknowns, Configuration& c) {
    context_.motion.scatter(unknowns, y);
    context_.motion.move(from, y, c);
    unknowns_to_multipliers(unknowns, c);
  };
  std::vector<double> guess(static_cast<std::size_t>(context_.numbering.equations()), 0.0);
  context_.motion.gather(y, guess);
  multipliers_to_unknowns(to, guess);
  context_.assembler.spread(guess, unknowns_);
  NewtonReport report = solve(unknowns_, {1, 0, 0}, apply, to);
  refuse_half_turns(y, report);
  return report;
}

NewtonReport Statics::balance_across_gaps(const Configuration& from, std::span<const double> prescribed, Configuration& to) {
  std::vector<double> y(prescribed.begin(), prescribed.end());
  NewtonReport report;
  int iterations = 0;
  for (const double contact_homotopy : {1.0, 0.1, 0.01, 1e-3, 1e-4, 1e-5, 1e-6, 0.0}) {
    context_.assembler.contact_homotopy = contact_homotopy;
    try {
      report = balance(from, y, to);
    } catch (...) {
      context_.assembler.contact_homotopy = 0;
      throw;
    }
    iterations += report.iterations;
    if (!report.converged) break;
  }
  context_.assembler.contact_homotopy = 0;
  report.iterations = iterations;
  return report;
}

}  // namespace engrane::solve
