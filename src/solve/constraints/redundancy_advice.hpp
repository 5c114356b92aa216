// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/SparseCore>
#include <string>

#include "assembly/assembler.hpp"

namespace engrane::solve {

/// Suggests joints to be made another kind so that no constraint is redundant any more and no freedom is gained: "HINGE 3
/// CYLINDRICAL instead, which releases its force along the axis". `null`: one column for each redundant constraint, the
/// combination of multipliers that causes no force. A set of constraints can be given up exactly if its rows of `null` are
/// independent. Joints that close loops come last in most decks and are changed first. Empty if there is no cure.
std::string suggest_releases(const Assembler& assembler, const Eigen::SparseMatrix<double>& null);

}  // namespace engrane::solve
