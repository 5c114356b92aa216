// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "assembly/assembler.hpp"

namespace engrane::solve {

/// Gives a matrix of the assembler its near-null space: the rigid-body translations and rotations of the model. Algebraic
/// multigrid must preserve them on its coarse grids.
void note_rigid_motions(const Assembler& assembler, Mat matrix);

}  // namespace engrane::solve
