// SPDX-License-Identifier: BSD-3-Clause
#include "solve/algebra/solver_cost.hpp"

#include <klu.h>

#include "solve/algebra/rows.hpp"

namespace engrane::solve {

namespace {

/// Entries and operations of MUMPS' factors over those that KLU predicts for its own: counted for a lattice of springs.
constexpr double more_entries = 1.25, more_operations = 1.7;

}  // namespace

SolverWork klu_work(double entries, double operations) { return {5 * operations + 60 * entries, 9 * entries}; }

SolverWork mumps_work(double rows, double entries, double operations) {
  return {3e5 + 7500 * rows + 0.7 * operations, 4.6e5 + 800 * rows + 9 * entries};
}

double ForeseenWork::other_over(const std::string& package) const {
  const double by_klu = klu.factor + klu.solution, by_mumps = mumps.factor + mumps.solution;
  return package == "KLU" ? by_mumps / by_klu : by_klu / by_mumps;
}

ForeseenWork foresee_work(Mat matrix) {
  const Rows rows(matrix);
  klu_common common;
  klu_defaults(&common);
  klu_symbolic* symbolic = klu_analyze(rows.size(), const_cast<int*>(rows.begin()), const_cast<int*>(rows.column()), &common);
  if (!symbolic) return {{1, 1}, {1, 1}};  // structurally singular: no package does better
  const double entries = symbolic->lnz + symbolic->unz, operations = symbolic->est_flops;
  klu_free_symbolic(&symbolic, &common);
  return {klu_work(entries, operations), mumps_work(rows.size(), more_entries * entries, more_operations * operations)};
}

std::string choose_package(Mat matrix, const std::string& wanted) {
  if (wanted == "CG" || wanted == "BLR") return wanted;
  if (!is_sequential(matrix)) return "MUMPS";
  if (wanted != "AUTO") return wanted;
  return foresee_work(matrix).other_over("KLU") >= 1 ? "KLU" : "MUMPS";
}

}  // namespace engrane::solve
