// SPDX-License-Identifier: BSD-3-Clause
#include "solve/algebra/linear.hpp"

#include <string>
#include <utility>

#include "solve/algebra/guarded.hpp"
#include "solve/algebra/rows.hpp"

namespace engrane::solve {

namespace {

/// Up to this many rows, one rank solves what several share (docs/decisions/0037-small-systems-on-one-rank.md).
constexpr PetscInt most_gathered = 3000;

bool worth_gathering(Mat matrix, const std::string& wanted) {
  return !is_sequential(matrix) && wanted != "CG" && rows_of(matrix) <= most_gathered;
}

int ranks_of(Mat matrix) {
  int ranks = 1;
  MPI_Comm_size(comm_of(matrix), &ranks);
  return ranks;
}

}  // namespace

LinearSolver::LinearSolver(Mat matrix, const std::string& package, const std::vector<unsigned char>& kinds)
    : matrix_(matrix), gathered_(worth_gathering(matrix, package) ? std::make_unique<GatheredSystem>(matrix) : nullptr) {
  const MPI_Comm comm = comm_of(matrix);
  const bool here = !gathered_ || gathered_->here();
  if (here) package_ = choose_package(factored(), package);
  if (gathered_) package_ = text_of_rank(0, package_, comm);
  if (here) factors_ = std::make_unique<JudgedFactors>(factored(), package_, kinds);
  check_petsc(PetscLogEventGetId("MatLUFactorNum", &factoring_));
  check_petsc(PetscLogEventGetId("MatSolve", &solving_));
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
  if (factors_) factors_->correct_only(corrections);
}

bool LinearSolver::solve(Vec right, Vec solution) {
  if (rows_of(matrix_) == 0) return true;  // all motion is prescribed; packages take an empty matrix for a singular one
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

void LinearSolver::rethrow() { solve::rethrow(failure_); }

void LinearSolver::reset() {
  if (factors_) factors_->reset();
}

template <class Act>
bool LinearSolver::agree(const Act& act) {
  if (!gathered_) return act();
  enum class Outcome { regular, singular, short_of_memory, failed };
  Outcome outcome = Outcome::regular;
  std::string trouble;
  if (factors_) {
    try {
      outcome = act() ? Outcome::regular : Outcome::singular;
      work_ = factors_->package().work();
    } catch (const MemoryShortage& shortage) {
      outcome = Outcome::short_of_memory;
      trouble = shortage.what();
    } catch (const std::exception& failure) {
      outcome = Outcome::failed;
      trouble = failure.what();
    }
  }
  double told[] = {static_cast<double>(outcome), work_.factor, work_.solution};
  const MPI_Comm comm = comm_of(matrix_);
  MPI_Bcast(told, 3, MPI_DOUBLE, 0, comm);
  outcome = static_cast<Outcome>(static_cast<int>(told[0]));
  work_ = {told[1], told[2]};
  if (outcome == Outcome::short_of_memory) throw MemoryShortage(text_of_rank(0, trouble, comm));
  if (outcome == Outcome::failed) throw PetscFailure(text_of_rank(0, trouble, comm));
  return outcome == Outcome::regular;
}

std::optional<ForeseenFactors> LinearSolver::foresee() {
  if (gathered_) return {};  // too small to matter
  return factors_->package().foresee();
}

bool LinearSolver::factor() {
  const LoggedTime logged(factoring_);
  if (announce) {
    if (const auto foreseen = foresee()) announce(*foreseen);
    announce = nullptr;
  }
  if (gathered_) gathered_->fetch_matrix();
  return agree([this] { return factors_->factor(); });
}

bool LinearSolver::solve_with_factors(Vec right, Vec solution) {
  const LoggedTime logged(solving_);
  if (!gathered_) return factors_->solve(right, solution);
  gathered_->fetch(right);
  const bool regular = agree([this] { return factors_->solve(gathered_->right(), gathered_->solution()); });
  if (regular) gathered_->give(solution);
  return regular;
}

PetscErrorCode LinearSolver::set_up(PC pc) {
  LinearSolver* self = nullptr;
  PetscCall(PCShellGetContext(pc, &self));
  return guarded(self->failure_, [&] {
    const bool regular = self->restored_ || self->factor();
    return PCSetFailedReason(pc, regular ? PC_NOERROR : PC_FACTOR_NUMERIC_ZEROPIVOT);
  });
}

PetscErrorCode LinearSolver::apply(PC pc, Vec right, Vec solution) {
  LinearSolver* self = nullptr;
  PetscCall(PCShellGetContext(pc, &self));
  return guarded(self->failure_, [&] {
    return self->solve_with_factors(right, solution) ? 0 : PCSetFailedReason(pc, PC_FACTOR_NUMERIC_ZEROPIVOT);
  });
}

void LinearSolver::save(Snapshot& snapshot) const {
  factors_->package().save(snapshot);
  snapshot.put("solver/proven", factors_->proven() ? 1 : 0);
  snapshot.put("solver/ranks", ranks_of(matrix_));
}

void LinearSolver::load(const Snapshot& snapshot) {
  // rows are numbered by rank: with another number of ranks the entries are in other places
  resumable_ = snapshot.number("solver/ranks") == ranks_of(matrix_);
  if (!resumable_) return;
  if (factors_) factors_->package().load(snapshot);
  proven_before_ = snapshot.number("solver/proven") != 0;
}

void LinearSolver::save_factors(Snapshot& snapshot) const {
  if (is_sequential(factored())) snapshot.put("factors/" + package_, values_of(factored()));
}

bool LinearSolver::load_factors(const Snapshot& snapshot) {
  const std::string name = "factors/" + package_;
  if (!resumable_ || !snapshot.has(name)) return false;
  const bool taken = agree([&] { return is_sequential(factored()) && set_values(factored(), snapshot.array(name)); });
  if (taken) make_factors_again();
  return taken;
}

void LinearSolver::restore_factors() {
  if (gathered_) gathered_->fetch_matrix();
  make_factors_again();
}

void LinearSolver::make_factors_again() {
  restored_ = agree([this] { return factors_->restore(proven_before_); });
  check_petsc(KSPSetUp(ksp_));  // finds them already made
  restored_ = false;
}

std::optional<double> LinearSolver::condition() { return factors_ ? factors_->condition() : std::nullopt; }

}  // namespace engrane::solve
