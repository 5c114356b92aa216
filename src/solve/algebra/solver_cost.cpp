// SPDX-License-Identifier: BSD-3-Clause
#include "solve/algebra/solver_cost.hpp"

#include <klu.h>

#include "solve/algebra/rows.hpp"

namespace engrane::solve {

SolverWork klu_work(double entries, double operations) { return {9 * operations + 25 * entries, 9 * entries}; }

SolverWork mumps_work(double entries, double) { return {3.1e5 + 408 * entries, 4.6e5 + 43 * entries}; }

ForeseenWork foresee_work(Mat matrix) {
  const Rows rows(matrix);
  klu_common common;
  klu_defaults(&common);
  klu_symbolic* symbolic = klu_analyze(rows.size(), const_cast<int*>(rows.begin()), const_cast<int*>(rows.column()), &common);
  // a pattern that is singular whatever the numbers: no package does better
  if (!symbolic) return {};
  const double entries = symbolic->lnz + symbolic->unz, operations = symbolic->est_flops;
  klu_free_symbolic(&symbolic, &common);
  return {klu_work(entries, operations), mumps_work(entries, operations)};
}

std::string choose_package(Mat matrix, const std::string& wanted) {
  PetscBool sequential = PETSC_FALSE;
  check_petsc(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(matrix), MATSEQAIJ, &sequential));
  if (!sequential) return "MUMPS";
  if (wanted != "AUTO") return wanted;
  return foresee_work(matrix).prefers_klu() ? "KLU" : "MUMPS";
}

}  // namespace engrane::solve
