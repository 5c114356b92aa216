// SPDX-License-Identifier: BSD-3-Clause
#include "solve/algebra/klu.hpp"

#include <algorithm>

#include "solve/algebra/rows.hpp"
#include "solve/algebra/solver_cost.hpp"

namespace engrane::solve {

namespace {

static_assert(sizeof(PetscInt) == sizeof(int), "KLU's int interface takes PETSc's indices as they are");

/// After n failures in a row old pivots are not tried for the next 2ⁿ matrices, but for at most this many: a trial costs a
/// factorisation and two solutions, and is worth a third of a factorisation if it succeeds.
constexpr int longest_wait = 64;

// KLU's interface is not const-correct
int* indices(const PetscInt* from) { return const_cast<int*>(from); }
double* values(const Rows& rows) { return const_cast<double*>(rows.value()); }

/// Copies `right` to `solution` and lets `with` solve in place.
template <class Solve>
void solve_in_place(Vec right, Vec solution, const Solve& with) {
  const PetscScalar* b = nullptr;
  PetscScalar* x = nullptr;
  PetscInt size = 0;
  check_petsc(VecGetLocalSize(right, &size));
  check_petsc(VecGetArrayRead(right, &b));
  check_petsc(VecGetArrayWrite(solution, &x));
  std::copy_n(b, size, x);
  with(size, x);
  check_petsc(VecRestoreArrayWrite(solution, &x));
  check_petsc(VecRestoreArrayRead(right, &b));
}

}  // namespace

Klu::Klu(Mat matrix) : matrix_(matrix) { klu_defaults(&common_); }

void Klu::free() {
  klu_free_numeric(&numeric_, &common_);
  klu_free_symbolic(&symbolic_, &common_);
}

void Klu::forget() {
  free();
  stale_ = false;
  trials_lost_ = wait_ = 0;
}

bool Klu::factor() {
  const bool regular = (numeric_ && wait_ == 0 && refactor()) || factor_with_new_pivots();
  if (wait_ > 0) --wait_;
  return regular;
}

bool Klu::refactor() {
  const Rows rows(matrix_);
  stale_ = klu_refactor(indices(rows.begin()), indices(rows.column()), values(rows), symbolic_, numeric_, &common_) == 1 &&
           common_.status == KLU_OK;
  return stale_;
}

bool Klu::factor_with_new_pivots() {
  chosen_for_ = values_of(matrix_);
  return factor_chosen();
}

bool Klu::factor_chosen() {
  const Rows rows(matrix_);
  stale_ = false;
  // to KLU rows are columns: it factors the transpose
  if (!symbolic_) symbolic_ = klu_analyze(rows.size(), indices(rows.begin()), indices(rows.column()), &common_);
  if (!symbolic_) return false;
  klu_free_numeric(&numeric_, &common_);
  numeric_ = klu_factor(indices(rows.begin()), indices(rows.column()), chosen_for_.data(), symbolic_, &common_);
  return numeric_ && common_.status == KLU_OK;
}

void Klu::solve(Vec right, Vec solution) {
  solve_in_place(right, solution, [&](PetscInt size, double* x) { klu_tsolve(symbolic_, numeric_, size, 1, x, &common_); });
}

void Klu::solve_transposed(Vec right, Vec solution) {
  solve_in_place(right, solution, [&](PetscInt size, double* x) { klu_solve(symbolic_, numeric_, size, 1, x, &common_); });
}

bool Klu::improve() {
  trials_lost_ = std::min(trials_lost_ + 1, 16);
  wait_ = std::min(1 << trials_lost_, longest_wait);
  return factor_with_new_pivots();
}

void Klu::served() {
  if (stale_) trials_lost_ = 0;
}

void Klu::save(Snapshot& snapshot) const {
  snapshot.put("klu/chosen_for", numeric_ ? chosen_for_ : std::vector<double>());
  snapshot.put("klu/trials_lost", trials_lost_);
  snapshot.put("klu/wait", wait_);
}

void Klu::load(const Snapshot& snapshot) {
  if (!snapshot.has("klu/chosen_for")) return;  // of another package
  forget();
  chosen_for_ = snapshot.array("klu/chosen_for");
  if (chosen_for_.size() == static_cast<std::size_t>(Rows(matrix_).entries())) factor_chosen();
  trials_lost_ = static_cast<int>(snapshot.number("klu/trials_lost"));
  wait_ = static_cast<int>(snapshot.number("klu/wait"));
}

bool Klu::restore() {
  if (!numeric_) return factor();
  bool same = false;
  {
    const Rows rows(matrix_);
    same = std::equal(chosen_for_.begin(), chosen_for_.end(), rows.value());
  }
  return same || refactor() || factor_with_new_pivots();
}

SolverWork Klu::work() const {
  if (!numeric_) return {};
  return klu_work(static_cast<double>(numeric_->lnz) + numeric_->unz, symbolic_->est_flops);
}

}  // namespace engrane::solve
