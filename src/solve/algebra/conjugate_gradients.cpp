// SPDX-License-Identifier: BSD-3-Clause
#include "solve/algebra/conjugate_gradients.hpp"

#include <fmt/format.h>

#include "solve/algebra/rows.hpp"

namespace engrane::solve {

namespace {

/// Of the residual. What it leaves is refined by another solution to the same precision (JudgedFactors).
constexpr double precision = 1e-8;
/// With more iterations factors are cheaper, if they fit.
constexpr PetscInt most_iterations = 1000;

}  // namespace

ConjugateGradients::ConjugateGradients(Mat matrix) : matrix_(matrix), symmetry_(matrix) {
  check_petsc(KSPCreate(comm_of(matrix), ksp_.out()));
  check_petsc(KSPSetOptionsPrefix(ksp_, "cg_"));
  check_petsc(KSPSetType(ksp_, KSPCG));
  check_petsc(KSPSetNormType(ksp_, KSP_NORM_UNPRECONDITIONED));
  check_petsc(KSPSetTolerances(ksp_, precision, 0, PETSC_DEFAULT, most_iterations));
  PC pc = nullptr;
  check_petsc(KSPGetPC(ksp_, &pc));
  check_petsc(PCSetType(pc, PCGAMG));
  check_petsc(KSPSetFromOptions(ksp_));
}

void ConjugateGradients::go_direct(const std::string& why) {
  direct_ = std::make_unique<Mumps>(matrix_);
  check_petsc(KSPReset(ksp_));
  remark_ = "SOLVER CG: " + why + ": MUMPS solved instead";
}

bool ConjugateGradients::factor() {
  if (direct_) return direct_->factor();
  if (!symmetry_.symmetric() || !symmetry_.positive_diagonal()) {
    go_direct("the matrix is not symmetric and positive definite (constraints, follower loads, gyroscopic forces)");
    return direct_->factor();
  }
  check_petsc(MatSetOption(matrix_, MAT_SPD, PETSC_TRUE));
  check_petsc(KSPSetOperators(ksp_, matrix_, matrix_));
  check_petsc(KSPSetUp(ksp_));
  return true;
}

std::optional<ForeseenFactors> ConjugateGradients::foresee() {
  return direct_ ? direct_->foresee() : std::optional<ForeseenFactors>{};
}

void ConjugateGradients::solve(Vec right, Vec solution) {
  if (direct_) return direct_->solve(right, solution);
  check_petsc(KSPSolve(ksp_, right, solution));
}

void ConjugateGradients::solve_transposed(Vec right, Vec solution) {
  if (direct_) return direct_->solve_transposed(right, solution);
  solve(right, solution);  // the matrix is symmetric
}

bool ConjugateGradients::improve() {
  if (direct_) return direct_->improve();
  PetscInt iterations = 0;
  check_petsc(KSPGetIterationNumber(ksp_, &iterations));
  go_direct(fmt::format("no accurate solution after {} iterations", iterations));
  return direct_->factor();
}

void ConjugateGradients::forget() {
  if (direct_) direct_->forget();
  check_petsc(KSPReset(ksp_));
}

void ConjugateGradients::save(Snapshot& snapshot) const {
  if (direct_) direct_->save(snapshot);
}

void ConjugateGradients::load(const Snapshot& snapshot) {
  if (direct_) direct_->load(snapshot);
}

double ConjugateGradients::bytes() const { return direct_ ? direct_->bytes() : 0; }

}  // namespace engrane::solve
