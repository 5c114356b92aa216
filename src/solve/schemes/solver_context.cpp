// SPDX-License-Identifier: BSD-3-Clause
#include "solve/schemes/solver_context.hpp"

#include <utility>

namespace engrane::solve {

SolverContext::SolverContext(const Model& m, SolverOptions chosen, MPI_Comm comm)
    : model(m),
      options(std::move(chosen)),
      numbering(m),
      assembler(m, numbering, comm),
      solver(assembler.matrix(), options.package),
      newton(assembler, solver, options.precision, options.iterations),
      motion(m, numbering),
      redundancy(assembler, motion),
      start(assembler, solver, motion, redundancy),
      grips(assembler, redundancy, start, options.step) {
  assembler.penalty = options.penalty;
}

SolverContext::SolverContext(const Model& m, MPI_Comm comm)
    : SolverContext(m, solver_options(m.commands.analysis, m.commands.stepping), comm) {}

void SolverContext::save(Snapshot& snapshot) const {
  assembler.save(snapshot);
  newton.save(snapshot);
  redundancy.save(snapshot);
  solver.save(snapshot);
}

void SolverContext::load(const Snapshot& snapshot) {
  assembler.load(snapshot);
  newton.load(snapshot);
  redundancy.load(snapshot);
  solver.load(snapshot);
}

}  // namespace engrane::solve
