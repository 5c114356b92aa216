// SPDX-License-Identifier: BSD-3-Clause
#include "solve/algebra/judged_factors.hpp"

#include <cmath>

#include "solve/algebra/condition.hpp"

namespace engrane::solve {

namespace {

/// If refinement changes a solution by more than this fraction of its largest entry, it does not converge: the matrix is
/// singular to working precision (Higham, Accuracy and Stability of Numerical Algorithms, 2002, section 12.1). The solution
/// then stays as it is: along a motion that nothing resists and nothing drives it contains rounding, and the correction that
/// rounding over rounding.
constexpr double most_refinement = 0.5;

double largest(Vec vector) {
  PetscReal norm = 0;
  check_petsc(VecNorm(vector, NORM_INFINITY, &norm));
  return norm;
}

}  // namespace

JudgedFactors::JudgedFactors(Mat matrix, const std::string& package, const std::vector<unsigned char>& kinds)
    : matrix_(matrix), factors_(make_factors(matrix, package)), backward_error_(matrix, kinds) {
  check_petsc(MatCreateVecs(matrix, correction_.out(), nullptr));
}

void JudgedFactors::correct_only(bool corrections) {
  const double enough = corrections ? fair_solution : good_solution;
  if (enough < enough_) proven_ = false;
  enough_ = enough;
}

void JudgedFactors::reset() {
  factors_->forget();
  state_ = State::forgotten;
}

bool JudgedFactors::factor() {
  proven_ = false;
  state_ = factors_->factor() ? State::ready : State::singular;
  return state_ == State::ready;
}

bool JudgedFactors::restore(bool proven) {
  state_ = factors_->restore() ? State::ready : State::singular;
  proven_ = proven;
  return state_ == State::ready;
}

bool JudgedFactors::solve(Vec right, Vec solution) {
  if (state_ == State::forgotten) factor();
  if (state_ == State::singular) return false;
  solve_well(right, solution);
  return state_ != State::singular && std::isfinite(error_);
}

void JudgedFactors::solve_well(Vec right, Vec solution) {
  solve_and_refine(right, solution);
  if (error_ <= fair_solution) return factors_->served();
  if (!factors_->improvable()) return;
  proven_ = false;
  state_ = factors_->improve() ? State::ready : State::singular;
  if (state_ == State::ready) solve_and_refine(right, solution);
}

void JudgedFactors::solve_and_refine(Vec right, Vec solution) {
  factors_->solve(right, solution);
  if (proven_) return;
  error_ = backward_error_.of(right, solution);
  proven_ = error_ <= enough_ && largest(solution) > 0;  // zeros prove nothing
  if (proven_ || !std::isfinite(error_)) return;
  factors_->solve(backward_error_.residual(), correction_);
  if (!(largest(correction_) <= most_refinement * largest(solution))) return;
  check_petsc(VecAXPY(solution, 1, correction_));
  // a solution that was good enough is still so after refinement
  if (error_ > fair_solution) error_ = backward_error_.of(right, solution);
}

std::optional<double> JudgedFactors::condition() {
  if (state_ != State::ready) return {};
  PetscReal norm = 0;
  check_petsc(MatNorm(matrix_, NORM_1, &norm));
  return norm * inverse_norm(*factors_, matrix_);
}

}  // namespace engrane::solve
