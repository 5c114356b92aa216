// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "solve/algebra/factors.hpp"

namespace engrane::solve {

/// Instructions of a factorisation with old pivots and of a solution by KLU, whose factors have so many entries and take so many
/// floating-point operations (docs/decisions/0027-solver-ladder.md).
SolverWork klu_work(double entries, double operations);
/// The same by MUMPS, of a matrix with so many rows.
SolverWork mumps_work(double rows, double entries, double operations);

/// What KLU and MUMPS would cost, foreseen from the pattern of a sequential matrix: the same in every run.
struct ForeseenWork {
  SolverWork klu, mumps;
  /// What a factorisation and a solution by the other one would cost over those by `package`, MUMPS or KLU.
  double other_over(const std::string& package) const;
};
ForeseenWork foresee_work(Mat matrix);

/// The package that solves: what the deck says, on several ranks MUMPS, and for AUTO the cheaper one of KLU and MUMPS.
std::string choose_package(Mat matrix, const std::string& wanted);

}  // namespace engrane::solve
