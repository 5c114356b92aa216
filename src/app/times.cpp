// SPDX-License-Identifier: BSD-3-Clause
#include "app/times.hpp"

#include <fmt/format.h>
#include <petsclog.h>
#include <petscsnes.h>

#include <algorithm>

#include "assembly/petsc.hpp"

namespace engrane::app {

using namespace output;
using namespace solve;

namespace {

PetscEventPerfInfo event(const char* name) {
  PetscLogEvent id = -1;
  PetscEventPerfInfo info{};
  check_petsc(PetscLogEventGetId(name, &id));
  if (id >= 0) check_petsc(PetscLogEventGetPerfInfo(0, id, &info));
  return info;
}

/// MUMPS spends about this long on a factorisation and a solve before any arithmetic, where KLU spends none to speak of
/// (docs/performance.md).
constexpr double overhead_of_mumps = 100e-6;

}  // namespace

Times::Times() {
  check_petsc(PetscLogDefaultBegin());
  // PETSc times every vector operation: of small mechanisms that is a twentieth of a step, and nobody reads it
  PetscBool viewed = PETSC_FALSE;
  check_petsc(PetscOptionsHasName(nullptr, nullptr, "-log_view", &viewed));
  if (viewed) return;
  for (const PetscClassId kind : {VEC_CLASSID, KSP_CLASSID, PC_CLASSID, SNESLINESEARCH_CLASSID})
    check_petsc(PetscLogEventDeactivateClass(kind));
}

TimeSplit Times::split(const LinearSolver& solver) const {
  TimeSplit split;
  split.total = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun_).count();
  const double factor = event("MatLUFactorSym").time + event("MatLUFactorNum").time;
  split.parts = {{"element residuals", event("Residual").time},
                 {"element tangents and assembly", event("Tangent").time},
                 {"factorisation (" + solver.package() + ")", factor},
                 {"solution (" + solver.package() + ")", event("MatSolve").time},
                 {"output", output_}};
  double known = 0;
  for (const auto& [name, seconds] : split.parts) known += seconds;
  split.parts.emplace_back("the rest", std::max(0.0, split.total - known));
  return split;
}

std::string Times::advice(const LinearSolver& solver, int ranks) const {
  const PetscEventPerfInfo factor = event("MatLUFactorNum"), solve = event("MatSolve");
  const double total = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun_).count();
  if (ranks > 1 || solver.package() != "MUMPS" || factor.count < 100 || total < 2) return {};
  const double each = (factor.time + solve.time) / factor.count;
  if (each > 3 * overhead_of_mumps) return {};
  const double gain = std::min(factor.time + solve.time, overhead_of_mumps * factor.count) / total;
  if (gain < 0.25) return {};
  return fmt::format(
      "engrane: this system is so small that MUMPS' own overhead takes about {:.0f} % of the time; .SAM SOLVER KLU "
      "would save most of it\n",
      100 * gain);
}

}  // namespace engrane::app
