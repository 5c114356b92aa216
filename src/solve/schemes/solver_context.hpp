// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "model/solver_options.hpp"
#include "solve/algebra/newton.hpp"
#include "solve/constraints/grips.hpp"
#include "solve/constraints/out_of_plane.hpp"
#include "solve/constraints/start.hpp"

namespace engrane::solve {

/// Objects shared by all schemes; made once per run, outlives the schemes.
struct SolverContext {
  SolverContext(const Model& model, SolverOptions options, MPI_Comm comm);
  /// With the options of the model's deck.
  SolverContext(const Model& model, MPI_Comm comm);

  /// State that the next step depends on besides the configuration, for a restart.
  void save(Snapshot& snapshot) const;
  void load(const Snapshot& snapshot);

  const Model& model;
  const SolverOptions options;
  Numbering numbering;
  Assembler assembler;
  LinearSolver solver;
  Newton newton;
  MotionSlots motion;
  Redundancy redundancy;
  Start start;
  Grips grips;
  OutOfPlane out_of_plane;
};

}  // namespace engrane::solve
