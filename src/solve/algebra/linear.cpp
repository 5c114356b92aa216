// SPDX-License-Identifier: BSD-3-Clause
#include "solve/algebra/linear.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solve/algebra/condition.hpp"
#include "solve/algebra/rows.hpp"

namespace engrane::solve {

namespace {

/// Refinement that changes a solution by more than this part of its largest entry does not converge: the matrix is singular to
/// working precision (Higham, Accuracy and Stability of Numerical Algorithms, 2002, section 12.1). The solution stays as it was:
/// of a motion that nothing resists and nothing drives it holds rounding, and the correction holds that over rounding.
constexpr double most_refinement = 0.5;

double largest(Vec vector) {
  PetscReal norm = 0;
  check_petsc(VecNorm(vector, NORM_INFINITY, &norm));
  return norm;
}

}  // namespace

LinearSolver::LinearSolver(Mat matrix, const std::string& package, const std::vector<unsigned char>& kinds)
    : matrix_(matrix),
      package_(choose_package(matrix, package)),
      factors_(make_factors(matrix, package_)),
      backward_error_(matrix, kinds) {
  check_petsc(PetscLogEventGetId("MatLUFactorNum", &factoring_));
  check_petsc(PetscLogEventGetId("MatSolve", &solving_));
  MPI_Comm comm = PETSC_COMM_SELF;
  check_petsc(PetscObjectGetComm(reinterpret_cast<PetscObject>(matrix), &comm));
  check_petsc(MatCreateVecs(matrix, correction_.out(), nullptr));
  check_petsc(KSPCreate(comm, ksp_.out()));
  check_petsc(KSPSetOperators(ksp_, matrix, matrix));
  check_petsc(KSPSetType(ksp_, KSPPREONLY));
  PC pc = nullptr;
  check_petsc(KSPGetPC(ksp_, &pc));
  check_petsc(PCSetType(pc, PCSHELL));
  check_petsc(PCShellSetName(pc, (package_ + ", its solutions judged").c_str()));
  check_petsc(PCShellSetContext(pc, this));
  check_petsc(PCShellSetSetUp(pc, set_up));
  check_petsc(PCShellSetApply(pc, apply));
  check_petsc(KSPSetFromOptions(ksp_));
}

void LinearSolver::correct_only(bool corrections) {
  const double enough = corrections ? fair_solution : good_solution;
  if (enough < enough_) proven_ = false;
  enough_ = enough;
}

bool LinearSolver::solve(Vec right, Vec solution) {
  correct_only(false);
  const PetscErrorCode code = KSPSolve(ksp_, right, solution);
  rethrow();
  check_petsc(code);
  KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
  check_petsc(KSPGetConvergedReason(ksp_, &reason));
  if (reason > 0) return true;
  reset();
  return false;
}

void LinearSolver::rethrow() {
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void LinearSolver::reset() {
  factors_->forget();
  state_ = State::forgotten;
}

bool LinearSolver::factor() {
  const LoggedTime logged(factoring_);
  proven_ = false;
  if (announce) {
    if (const auto foreseen = factors_->foresee()) announce(*foreseen);
    announce = nullptr;
  }
  state_ = factors_->factor() ? State::ready : State::singular;
  return state_ == State::ready;
}

PetscErrorCode LinearSolver::set_up(PC pc) {
  LinearSolver* self = nullptr;
  PetscCall(PCShellGetContext(pc, &self));
  try {
    const bool regular = self->restored_ || self->factor();
    return PCSetFailedReason(pc, regular ? PC_NOERROR : PC_FACTOR_NUMERIC_ZEROPIVOT);
  } catch (...) {
    self->failure_ = std::current_exception();
    return PETSC_ERR_LIB;
  }
}

PetscErrorCode LinearSolver::apply(PC pc, Vec right, Vec solution) {
  LinearSolver* self = nullptr;
  PetscCall(PCShellGetContext(pc, &self));
  try {
    if (self->state_ == State::forgotten) self->factor();
    if (self->state_ == State::singular) return PCSetFailedReason(pc, PC_FACTOR_NUMERIC_ZEROPIVOT);
    const LoggedTime logged(self->solving_);
    self->solve_well(right, solution);
    if (self->state_ == State::singular || !std::isfinite(self->error_))
      return PCSetFailedReason(pc, PC_FACTOR_NUMERIC_ZEROPIVOT);
  } catch (...) {
    self->failure_ = std::current_exception();
    return PETSC_ERR_LIB;
  }
  return 0;
}

void LinearSolver::solve_well(Vec right, Vec solution) {
  solve_and_refine(right, solution);
  if (error_ <= fair_solution) return factors_->served();
  if (!factors_->improvable()) return;
  proven_ = false;
  state_ = factors_->improve() ? State::ready : State::singular;
  if (state_ == State::ready) solve_and_refine(right, solution);
}

void LinearSolver::solve_and_refine(Vec right, Vec solution) {
  factors_->solve(right, solution);
  if (proven_) return;
  error_ = backward_error_.of(right, solution);
  proven_ = error_ <= enough_;
  if (proven_ || !std::isfinite(error_)) return;
  factors_->solve(backward_error_.residual(), correction_);
  if (!(largest(correction_) <= most_refinement * largest(solution))) return;
  check_petsc(VecAXPY(solution, 1, correction_));
  // what was good enough before is so after it
  if (error_ > fair_solution) error_ = backward_error_.of(right, solution);
}

void LinearSolver::save(Snapshot& snapshot) const {
  factors_->save(snapshot);
  snapshot.put("solver/proven", proven_ ? 1 : 0);
}

void LinearSolver::load(const Snapshot& snapshot) {
  factors_->load(snapshot);
  if (snapshot.has("solver/proven")) proven_before_ = snapshot.number("solver/proven") != 0;
}

void LinearSolver::save_factors(Snapshot& snapshot) const {
  if (is_sequential(matrix_)) snapshot.put("factors/" + package_, values_of(matrix_));
}

bool LinearSolver::load_factors(const Snapshot& snapshot) {
  const std::string name = "factors/" + package_;
  if (!is_sequential(matrix_) || !snapshot.has(name) || !set_values(matrix_, snapshot.array(name))) return false;
  restore_factors();
  return true;
}

void LinearSolver::restore_factors() {
  restored_ = factors_->restore();
  state_ = restored_ ? State::ready : State::singular;
  proven_ = proven_before_;
  check_petsc(KSPSetUp(ksp_));  // finds them made
  restored_ = false;
}

std::optional<double> LinearSolver::condition() {
  if (state_ != State::ready) return {};
  PetscReal norm = 0;
  check_petsc(MatNorm(matrix_, NORM_1, &norm));
  return norm * inverse_norm(*factors_, matrix_);
}

}  // namespace engrane::solve
