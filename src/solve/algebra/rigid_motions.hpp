// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "assembly/assembler.hpp"

namespace engrane::solve {

/// Tells a matrix of the assembler what its model resists least: translations and rotations of the whole. Algebraic multigrid
/// must not lose them on its way to few unknowns.
void note_rigid_motions(const Assembler& assembler, Mat matrix);

}  // namespace engrane::solve
