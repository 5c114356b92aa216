// SPDX-License-Identifier: BSD-3-Clause
#include "app/check.hpp"

#include <fmt/format.h>

#include <ostream>

#include "app/options.hpp"
#include "app/price.hpp"
#include "app/summary.hpp"
#include "app/terminal.hpp"
#include "base/text.hpp"
#include "solve/constraints/diagnosis.hpp"
#include "solve/schemes/scheme.hpp"
#include "user/library.hpp"

namespace engrane::app {

using namespace output;
using namespace solve;

namespace {

constexpr std::size_t most_shown_bodies = 20;

}  // namespace

int print_model(const Reading& reading, std::ostream& out) {
  const Model& model = reading.model;
  SolverContext context(model, PETSC_COMM_SELF);
  if (!model.title.empty()) out << printable(model.title) << '\n';
  out << describe_analysis(context) << "\n\n" << listing_built(summarize(model, context.numbering)) << describe_geometry(model);
  if (const std::string masses = describe_masses(model, most_shown_bodies); !masses.empty()) out << "\nMasses\n" << masses;
  if (!model.commands.checks.empty())
    out << fmt::format("\n  {} (.CHK) will be made\n", counted(model.commands.checks.size(), "check"));
  for (const std::string& file : user::Library::loaded())
    out << terminal_text(fmt::format("\n  user routines were loaded from {}, and tried\n", file));
  if (const std::string text = reading.assumptions(); !text.empty()) out << fmt::format("\n  {}\n", text);
  Configuration c = context.numbering.reference_configuration(model.commands.stepping.start);
  StartReport report;
  try {
    apply_initial_displacements(context, c);
    context.start.assemble(c, report);
    const bool moves = context.options.moves();
    // drives may agree on positions but not on velocities; supports move nodes only if there is motion
    if (moves) {
      apply_initial_velocities(context, c);
      context.start.fit_velocities(c, Assembler::Metric::geometric, report);
    } else {
      context.start.project_velocities(c, Assembler::Metric::geometric);
    }
    if (context.options.analysis == SolverOptions::Analysis::kinematics)
      if (const std::string free = explain_free_motion(context.assembler, c, context.redundancy.mobility()); !free.empty())
        throw SolutionFailure(free);
    if (context.options.analysis == SolverOptions::Analysis::dynamics)
      if (const std::string unheld = MasslessMotions(context.assembler, c).explain_unheld(context.assembler, c); !unheld.empty())
        throw SolutionFailure(unheld);
  } catch (const SolutionFailure& failure) {
    out << "\n  " << failure.what() << '\n';
    return exit_status::solution_failed;
  }
  out << "\nThe start\n"
      << describe_start(model, report) << '\n'
      << describe_mobility(context.assembler, c, context.redundancy.mobility());
  try {
    out << describe_price(reading, context, c);
  } catch (const MemoryShortage& shortage) {
    out << "\n  " << shortage.what() << '\n';
    return exit_status::solution_failed;
  }
  return exit_status::fine;
}

}  // namespace engrane::app
