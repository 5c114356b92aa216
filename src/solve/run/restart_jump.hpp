// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "assembly/configuration.hpp"
#include "solve/schemes/solver_context.hpp"

namespace engrane::solve {

/// Names the drive that asks for another place than the one where its joint stands in `c`, or else the element whose constraints
/// are open there; empty if all are closed. A motion cannot be continued from such a place: the first step would make the jump,
/// with the velocity of the jump over the step. Every rank finds the same.
std::string explain_jump(SolverContext& context, const Configuration& c);

}  // namespace engrane::solve
