// SPDX-License-Identifier: BSD-3-Clause
#include "solve/schemes/solver_context.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "model/linear_statics.hpp"
#include "solve/algebra/rigid_motions.hpp"

namespace engrane::solve {

namespace {

/// Whether MUMPS factors a single tangent that is symmetric by construction, so that half of it is enough.
bool half_is_enough(const Model& model, const SolverOptions& options, const Numbering& numbering) {
  return (options.package == "MUMPS" || options.package == "BLR") && options.analysis == SolverOptions::Analysis::statics &&
         !options.path.follow && !model.commands.buckling && numbering.partition().ranks() == 1 &&
         numbering.slots() == numbering.motion_slots() &&
         std::all_of(model.parts.begin(), model.parts.end(),
                     [](const Model::Part& part) { return part.element->is_linear() && part.element->layout().scalars.empty(); });
}

}  // namespace

SolverContext::SolverContext(const Model& m, SolverOptions chosen, MPI_Comm comm)
    : model(m),
      options(std::move(chosen)),
      numbering(m, Partition(m, comm)),
      assembler(m, numbering, comm, half_is_enough(m, options, numbering)),
      solver(assembler.matrix(), options.package, kinds_of_rows(numbering)),
      newton(assembler, solver, options.precision, options.iterations),
      motion(m, numbering, is_linear_statics(m)),
      redundancy(assembler, motion),
      start(assembler, solver, motion, redundancy),
      grips(assembler, redundancy, start, options),
      out_of_plane(assembler) {
  assembler.penalty = options.penalty;
  if (options.package == "CG") note_rigid_motions(assembler, assembler.matrix());
}

SolverContext::SolverContext(const Model& m, MPI_Comm comm) : SolverContext(m, solver_options(m), comm) {}

void SolverContext::save(Snapshot& snapshot) const {
  assembler.save(snapshot);
  newton.save(snapshot);
  redundancy.save(snapshot);
  solver.save(snapshot);
  snapshot.put("plane", model.plane.normal);
}

void SolverContext::load(const Snapshot& snapshot) {
  const auto words = [](int normal) {
    return normal < 0 ? std::string("in space") : fmt::format("in the plane {}", plane_name(normal));
  };
  const int before = static_cast<int>(snapshot.number("plane"));
  if (before != model.plane.normal)
    throw SolutionFailure(
        fmt::format("the run that wrote the restart point was solved {}, this one is solved {}: give the same PLANE in .SAM",
                    words(before), words(model.plane.normal)));
  assembler.load(snapshot);
  redundancy.load(snapshot);
  solver.load(snapshot);
  newton.load(snapshot);  // factors, with the restored state of the solver
}

}  // namespace engrane::solve
