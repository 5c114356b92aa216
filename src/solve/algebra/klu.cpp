// SPDX-License-Identifier: BSD-3-Clause
#include "solve/algebra/klu.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace engrane::solve {

namespace {

static_assert(sizeof(PetscInt) == sizeof(int), "KLU's int interface takes PETSc's indices as they are");

/// A solution as good as this is that of a matrix that nobody can tell from the given one.
constexpr double good = 1e-14;
/// Where neither the first solution nor its refinement is as good as this, the old pivots serve no longer.
constexpr double worst_kept = 1e-11;
/// After old pivots were useless n times in a row they are not tried for the next 2ⁿ matrices, but not longer than for this many:
/// a trial costs a factorisation and two solutions, and is worth a third of a factorisation when it succeeds.
constexpr int longest_wait = 64;

/// The values of a sequential matrix, for as long as this lives.
class Values {
 public:
  explicit Values(Mat matrix) : matrix_(matrix) { check_petsc(MatSeqAIJGetArrayRead(matrix, &values_)); }
  ~Values() { (void)MatSeqAIJRestoreArrayRead(matrix_, &values_); }
  Values(const Values&) = delete;
  Values& operator=(const Values&) = delete;
  // KLU's interface predates const
  double* get() const { return const_cast<double*>(values_); }

 private:
  Mat matrix_;
  const PetscScalar* values_ = nullptr;
};

}  // namespace

Klu::Klu(Mat matrix) : matrix_(matrix), enough_(good) {
  klu_defaults(&common_);
  check_petsc(PetscLogEventGetId("MatLUFactorNum", &factoring_));
  check_petsc(PetscLogEventGetId("MatSolve", &solving_));
}

void Klu::serve(PC pc) {
  check_petsc(PCSetType(pc, PCSHELL));
  check_petsc(PCShellSetName(pc, "KLU, its pivots kept"));
  check_petsc(PCShellSetContext(pc, this));
  check_petsc(PCShellSetSetUp(pc, set_up));
  check_petsc(PCShellSetApply(pc, apply));
}

void Klu::correct_only(bool corrections) {
  const double enough = corrections ? worst_kept : good;
  if (enough < enough_) proven_ = false;
  enough_ = enough;
}

void Klu::forget() {
  klu_free_numeric(&numeric_, &common_);
  klu_free_symbolic(&symbolic_, &common_);
  restored_ = proven_ = false;
  trials_lost_ = wait_ = 0;
}

void Klu::find_pattern() {
  if (begin_) return;
  PetscBool done = PETSC_FALSE;
  PetscInt rows = 0;
  check_petsc(MatGetRowIJ(matrix_, 0, PETSC_FALSE, PETSC_FALSE, &rows, &begin_, &column_, &done));
  size_ = rows;
  residual_.resize(static_cast<std::size_t>(rows));
  terms_.resize(residual_.size());
}

bool Klu::refactor() { return numeric_ && wait_ == 0 && refactor_now(); }

bool Klu::refactor_now() {
  const Values values(matrix_);
  stale_ = klu_refactor(const_cast<PetscInt*>(begin_), const_cast<PetscInt*>(column_), values.get(), symbolic_, numeric_,
                        &common_) == 1 &&
           common_.status == KLU_OK;
  return stale_;
}

bool Klu::factor() {
  const Values values(matrix_);
  chosen_for_.assign(values.get(), values.get() + begin_[size_]);
  return factor_chosen();
}

bool Klu::factor_chosen() {
  stale_ = false;
  auto *begin = const_cast<PetscInt*>(begin_), *column = const_cast<PetscInt*>(column_);
  if (!symbolic_) symbolic_ = klu_analyze(size_, begin, column, &common_);
  if (!symbolic_) return false;
  klu_free_numeric(&numeric_, &common_);
  numeric_ = klu_factor(begin, column, chosen_for_.data(), symbolic_, &common_);
  return numeric_ && common_.status == KLU_OK;
}

void Klu::save(Snapshot& snapshot) const {
  snapshot.put("klu/chosen_for", numeric_ ? chosen_for_ : std::vector<double>());
  snapshot.put("klu/trials_lost", trials_lost_);
  snapshot.put("klu/wait", wait_);
  snapshot.put("klu/proven", proven_ ? 1.0 : 0.0);
}

void Klu::load(const Snapshot& snapshot) {
  forget();
  find_pattern();
  chosen_for_ = snapshot.array("klu/chosen_for");
  if (chosen_for_.size() == static_cast<std::size_t>(begin_[size_])) factor_chosen();
  trials_lost_ = static_cast<int>(snapshot.number("klu/trials_lost"));
  wait_ = static_cast<int>(snapshot.number("klu/wait"));
  proven_before_ = snapshot.number("klu/proven") != 0;
}

void Klu::restore_factors() {
  if (!numeric_) return;
  bool same = false;
  {
    const Values values(matrix_);
    same = std::equal(chosen_for_.begin(), chosen_for_.end(), values.get());
  }
  restored_ = same || refactor_now();
  proven_ = proven_before_;
}

double Klu::backward_error(const double* right, const double* solution) {
  const Values values(matrix_);
  const double* a = values.get();
  std::array<double, 8> largest{};
  const bool told = kinds_.size() == terms_.size();
  for (int row = 0; row < size_; ++row) {
    double remainder = right[row], terms = std::abs(right[row]);
    for (PetscInt k = begin_[row]; k < begin_[row + 1]; ++k) {
      const double term = a[k] * solution[column_[k]];
      remainder -= term;
      terms += std::abs(term);
    }
    residual_[static_cast<std::size_t>(row)] = remainder;
    if (std::isnan(terms) || std::isinf(terms)) return std::numeric_limits<double>::infinity();
    terms_[static_cast<std::size_t>(row)] = terms;
    if (told) largest[kinds_[static_cast<std::size_t>(row)]] = std::max(largest[kinds_[static_cast<std::size_t>(row)]], terms);
  }
  double worst = 0;
  for (std::size_t row = 0; row < terms_.size(); ++row) {
    double terms = terms_[row];
    if (told && terms <= worst_kept * largest[kinds_[row]]) terms = largest[kinds_[row]];
    if (terms > 0) worst = std::max(worst, std::abs(residual_[row]) / terms);
  }
  return worst;
}

double Klu::solve(const double* right, double* solution) {
  // the factors are those of the transpose
  std::copy_n(right, size_, solution);
  klu_tsolve(symbolic_, numeric_, size_, 1, solution, &common_);
  if (proven_) return enough_;
  const double error = backward_error(right, solution);
  proven_ = error <= enough_;
  if (proven_ || !std::isfinite(error)) return error;
  klu_tsolve(symbolic_, numeric_, size_, 1, residual_.data(), &common_);
  for (int i = 0; i < size_; ++i) solution[i] += residual_[static_cast<std::size_t>(i)];
  // what was good enough before is so after it
  return error <= worst_kept ? error : backward_error(right, solution);
}

PetscErrorCode Klu::set_up(PC pc) {
  Klu* self = nullptr;
  PetscCall(PCShellGetContext(pc, &self));
  self->find_pattern();
  if (self->restored_) {
    self->restored_ = false;
    return PCSetFailedReason(pc, PC_NOERROR);
  }
  self->proven_ = false;
  PetscCall(PetscLogEventBegin(self->factoring_, pc, nullptr, nullptr, nullptr));
  const bool regular = self->refactor() || self->factor();
  if (self->wait_ > 0) --self->wait_;
  PetscCall(PetscLogEventEnd(self->factoring_, pc, nullptr, nullptr, nullptr));
  PetscCall(PCSetFailedReason(pc, regular ? PC_NOERROR : PC_FACTOR_NUMERIC_ZEROPIVOT));
  return 0;
}

PetscErrorCode Klu::apply(PC pc, Vec right, Vec solution) {
  Klu* self = nullptr;
  PetscCall(PCShellGetContext(pc, &self));
  const PetscScalar* b = nullptr;
  PetscScalar* x = nullptr;
  PetscCall(VecGetArrayRead(right, &b));
  PetscCall(VecGetArrayWrite(solution, &x));
  PetscCall(PetscLogEventBegin(self->solving_, pc, nullptr, nullptr, nullptr));
  double error = self->solve(b, x);
  if (self->stale_ && error <= worst_kept) self->trials_lost_ = 0;
  if (self->stale_ && !(error <= worst_kept)) {
    self->wait_ = std::min(1 << ++self->trials_lost_, longest_wait);
    self->trials_lost_ = std::min(self->trials_lost_, 16);
    self->proven_ = false;
    error = self->factor() ? self->solve(b, x) : std::numeric_limits<double>::infinity();
  }
  PetscCall(PetscLogEventEnd(self->solving_, pc, nullptr, nullptr, nullptr));
  PetscCall(VecRestoreArrayRead(right, &b));
  PetscCall(VecRestoreArrayWrite(solution, &x));
  if (!std::isfinite(error)) PetscCall(PCSetFailedReason(pc, PC_FACTOR_NUMERIC_ZEROPIVOT));
  return 0;
}

}  // namespace engrane::solve
