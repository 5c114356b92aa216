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

/// Limits for advice. The first is the smallest fraction of the run's time worth saving. The second is the largest ratio of the
/// other solver's operation count to this one's; times are only roughly proportional to it.
constexpr double worth_saying = 0.25;
constexpr double clearly_less = 0.7;

}  // namespace

Times::Sum Times::Event::now() const {
  PetscLogEvent id = -1;
  PetscEventPerfInfo info{};
  check_petsc(PetscLogEventGetId(name, &id));
  if (id >= 0) check_petsc(PetscLogEventGetPerfInfo(0, id, &info));
  return {info.time, info.count};
}

Times::Sum Times::Event::since() const {
  const Sum all = now();
  return {all.time - before.time, all.count - before.count};
}

Times::Times() {
  check_petsc(PetscLogDefaultBegin());
  // PETSc times everything it does, which in a small mechanism takes a sixth of a step, and shows it only with -log_view. Only
  // its two solver events are needed, and those of this program, which belong to no class of PETSc.
  PetscBool viewed = PETSC_FALSE;
  check_petsc(PetscOptionsHasName(nullptr, nullptr, "-log_view", &viewed));
  if (!viewed) leave_out_the_rest();
  for (Event* one : {&residuals_, &tangents_, &factorisations_, &solutions_}) one->before = one->now();
}

void Times::leave_out_the_rest() {
  // events have no numbers before these calls
  for (const auto initialise :
       {VecInitializePackage, MatInitializePackage, KSPInitializePackage, PCInitializePackage, SNESInitializePackage})
    check_petsc(initialise());
  for (const PetscClassId kind : {VEC_CLASSID, MAT_CLASSID, KSP_CLASSID, PC_CLASSID, SNES_CLASSID, SNESLINESEARCH_CLASSID})
    check_petsc(PetscLogEventDeactivateClass(kind));
  for (const Event* one : {&factorisations_, &solutions_}) {
    PetscLogEvent id = -1;
    check_petsc(PetscLogEventGetId(one->name, &id));
    check_petsc(PetscLogEventActivate(id));
  }
}

TimeSplit Times::split(const LinearSolver& solver) const {
  TimeSplit split;
  split.total = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun_).count();
  split.parts = {{"element residuals", residuals_.since().time},
                 {"element tangents and assembly", tangents_.since().time},
                 {"factorisation (" + solver.package() + ")", factorisations_.since().time},  // includes the symbolic analysis
                 {"solution (" + solver.package() + ")", solutions_.since().time},
                 {"output", output_}};
  double known = 0;
  for (const auto& [name, seconds] : split.parts) known += seconds;
  split.parts.emplace_back("the rest", std::max(0.0, split.total - known));
  return split;
}

std::string Times::advice(const LinearSolver& solver, int ranks) const {
  const bool mumps = solver.package() == "MUMPS";
  if (ranks > 1 || (!mumps && solver.package() != "KLU")) return {};
  const Sum factor = factorisations_.since(), solve = solutions_.since();
  const double total = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun_).count();
  if (factor.count < 100 || total < 2) return {};
  const double part = solver.foreseen().other_over(solver.package());
  const double gain = (1 - part) * (factor.time + solve.time) / total;
  if (part > clearly_less || gain < worth_saying) return {};
  return fmt::format(
      "engrane: {} takes {:.0f} % of the time; .SAM SOLVER {} is expected to take {:.0f} % of that. SOLVER AUTO chooses it\n",
      solver.package(), 100 * (factor.time + solve.time) / total, mumps ? "KLU" : "MUMPS", 100 * part);
}

}  // namespace engrane::app
