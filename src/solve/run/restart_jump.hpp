// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "assembly/configuration.hpp"
#include "base/snapshot.hpp"
#include "model/jump.hpp"
#include "model/model.hpp"
#include "solve/schemes/solver_context.hpp"

namespace engrane::solve {

/// Names the drive that asks for another place than the one where its joint stands in `c`, or else the element whose constraints
/// are open there; empty if all are closed. A motion cannot be continued from such a place: the first step would make the jump,
/// with the velocity of the jump over the step. Every rank finds the same.
std::string explain_jump(SolverContext& context, const Configuration& c);

/// Saves the speeds of drives and supports in the motion up to a restart point, and reads them back. The velocities
/// there do not show them: between fixed steps they are only near what is imposed.
void save_speeds(const std::vector<ValueAndRate>& speeds, Snapshot& snapshot);
std::vector<ValueAndRate> load_speeds(const Model& model, const Snapshot& snapshot, double time);

}  // namespace engrane::solve
