// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "solve/algebra/factors.hpp"

namespace engrane::solve {

/// Instructions of a factorisation with old pivots and of a solution by KLU, and of the same by MUMPS, whose factors have so many
/// entries and take so many floating-point operations (docs/decisions/0027-solver-ladder.md).
SolverWork klu_work(double entries, double operations);
SolverWork mumps_work(double entries, double operations);

/// What KLU and MUMPS would cost, foreseen from the pattern of a sequential matrix: the same in every run.
struct ForeseenWork {
  SolverWork klu, mumps;
  /// Whether KLU is the cheaper one for one factorisation and one solution.
  bool prefers_klu() const { return klu.factor + klu.solution <= mumps.factor + mumps.solution; }
};
ForeseenWork foresee_work(Mat matrix);

/// The package that solves: what the deck says, on several ranks MUMPS, and for AUTO the cheaper one of KLU and MUMPS.
std::string choose_package(Mat matrix, const std::string& wanted);

}  // namespace engrane::solve
