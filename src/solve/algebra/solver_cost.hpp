// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "solve/algebra/factors.hpp"

namespace engrane::solve {

/// Instructions of a factorisation with old pivots and of a solution by KLU, for factors with this number of entries and of
/// floating-point operations (docs/decisions/0027-solver-ladder.md).
SolverWork klu_work(double entries, double operations);
/// Instructions of MUMPS, for a matrix with this number of rows.
SolverWork mumps_work(double rows, double entries, double operations);

/// Cost of KLU and MUMPS, predicted from the pattern of a sequential matrix: the same in every run.
struct ForeseenWork {
  SolverWork klu, mumps;
  /// Cost of a factorisation and a solution by the other package over that by `package`, MUMPS or KLU.
  double other_over(const std::string& package) const;
};
ForeseenWork foresee_work(Mat matrix);

/// Returns the package to use: that of the deck, on several ranks MUMPS (or CG), and for AUTO the cheaper one of KLU and MUMPS.
std::string choose_package(Mat matrix, const std::string& wanted);

}  // namespace engrane::solve
