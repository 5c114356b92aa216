// SPDX-License-Identifier: BSD-3-Clause
#include "solve/algebra/conjugate_gradients.hpp"

#include <fmt/format.h>

#include <limits>
#include <utility>

#include "solve/algebra/rows.hpp"

namespace engrane::solve {

namespace {

/// Of the residual. What it leaves is refined by another solution to the same precision (JudgedFactors).
constexpr double precision = 1e-8;
/// With more iterations factors are cheaper, if they fit.
constexpr PetscInt most_iterations = 1000;
/// In a row. What is lost to them is bounded, and an analysis has few kinds of matrices (masses, masses with stiffness).
constexpr int most_failures = 3;

std::string explain(KSPConvergedReason reason, PetscInt iterations) {
  if (reason == KSP_DIVERGED_ITS) return fmt::format("conjugate gradients did not converge in {} iterations", iterations);
  if (reason == KSP_DIVERGED_INDEFINITE_MAT) return "the matrix is not positive definite";
  return fmt::format("conjugate gradients failed after {} iterations ({})", iterations, KSPConvergedReasons[reason]);
}

}  // namespace

void ConjugateGradients::set_up(Preconditioner preconditioner) {
  // From new for every matrix: PETSc's multigrid keeps smoothers when it is reset, and with those of a mass matrix it is
  // indefinite for a mass with stiffness (PETSc 3.18).
  check_petsc(KSPCreate(comm_of(matrix_), ksp_.out()));
  check_petsc(KSPSetOptionsPrefix(ksp_, "cg_"));
  check_petsc(KSPSetType(ksp_, KSPCG));
  check_petsc(KSPSetNormType(ksp_, KSP_NORM_UNPRECONDITIONED));
  check_petsc(KSPSetTolerances(ksp_, precision, 0, PETSC_DEFAULT, most_iterations));
  check_petsc(KSPConvergedDefaultSetUIRNorm(ksp_));  // of what is left where a solution is continued
  PC pc = nullptr;
  check_petsc(KSPGetPC(ksp_, &pc));
  check_petsc(PCSetType(pc, PCGAMG));
  check_petsc(KSPSetFromOptions(ksp_));
  if (preconditioner == Preconditioner::diagonal) check_petsc(PCSetType(pc, PCJACOBI));
  check_petsc(MatSetOption(matrix_, MAT_SPD, PETSC_TRUE));
  check_petsc(KSPSetOperators(ksp_, matrix_, matrix_));
  check_petsc(KSPSetUp(ksp_));
}

bool ConjugateGradients::factor() {
  ++matrices_;
  continues_ = false;
  if (!direct_) failures_ = 0;
  if (!symmetry_.positive_diagonal() || !symmetry_.symmetric()) {
    why_ = "the matrix is not symmetric and positive definite (constraints, follower loads, gyroscopic forces)";
    return factor_directly();
  }
  if (failures_ == most_failures) return factor_directly();
  direct_.reset();
  set_up(Preconditioner::multigrid);
  return true;
}

bool ConjugateGradients::factor_directly() {
  ++left_;
  if (!direct_) {
    ksp_ = {};
    direct_ = std::make_unique<Mumps>(matrix_);
  }
  return direct_->factor();
}

std::optional<ForeseenFactors> ConjugateGradients::foresee() {
  return direct_ ? direct_->foresee() : std::optional<ForeseenFactors>{};
}

void ConjugateGradients::solve(Vec right, Vec solution) {
  if (!direct_) {
    if (iterate(right, solution)) return;
    ++failures_;
    if (!factor_directly()) return check_petsc(VecSet(solution, std::numeric_limits<double>::quiet_NaN()));
  }
  direct_->solve(right, solution);
}

bool ConjugateGradients::iterate(Vec right, Vec solution) {
  check_petsc(KSPSetInitialGuessNonzero(ksp_, std::exchange(continues_, false) ? PETSC_TRUE : PETSC_FALSE));
  check_petsc(KSPSolve(ksp_, right, solution));
  KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
  check_petsc(KSPGetConvergedReason(ksp_, &reason));
  if (reason < 0 && reason != KSP_DIVERGED_ITS && reason != KSP_DIVERGED_INDEFINITE_MAT) {
    set_up(Preconditioner::diagonal);  // positive definite where multigrid is not
    check_petsc(KSPSolve(ksp_, right, solution));
    check_petsc(KSPGetConvergedReason(ksp_, &reason));
  }
  if (reason > 0) return true;
  PetscInt iterations = 0;
  check_petsc(KSPGetIterationNumber(ksp_, &iterations));
  why_ = explain(reason, iterations);
  return false;
}

void ConjugateGradients::solve_transposed(Vec right, Vec solution) {
  if (direct_) return direct_->solve_transposed(right, solution);
  solve(right, solution);  // the matrix is symmetric
}

bool ConjugateGradients::improve() {
  if (direct_) return direct_->improve();
  // `precision` is a fraction of the whole residual. Rows are judged one by one, and some carry much less than others, as those
  // far from a load that a mass matrix spreads. Each continuation and each refinement leaves `precision` of what there is, down
  // to the rounding of every row.
  continues_ = true;
  return true;
}

void ConjugateGradients::forget() {
  if (direct_) direct_->forget();
  ksp_ = {};
}

void ConjugateGradients::save(Snapshot& snapshot) const {
  if (direct_) direct_->save(snapshot);
}

void ConjugateGradients::load(const Snapshot& snapshot) {
  if (direct_) direct_->load(snapshot);
}

double ConjugateGradients::bytes() const { return direct_ ? direct_->bytes() : 0; }

std::string ConjugateGradients::remark() const {
  if (left_ == 0) return {};
  return fmt::format("SOLVER CG: MUMPS solved instead, {} of {} matrices: {}", left_, matrices_, why_);
}

}  // namespace engrane::solve
