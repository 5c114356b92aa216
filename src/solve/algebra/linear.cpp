// SPDX-License-Identifier: BSD-3-Clause
#include "solve/algebra/linear.hpp"

#include <algorithm>
#include <cmath>

namespace engrane::solve {

namespace {

/// Up to so many unknowns KLU takes less time than MUMPS; of chains and frames beyond too, which is no promise for meshes
/// (docs/performance.md).
constexpr PetscInt most_for_klu = 5000;

MatSolverType petsc_name(const std::string& package) {
  if (package == "UMFPACK") return MATSOLVERUMFPACK;
  if (package == "SUPERLU") return MATSOLVERSUPERLU;
  return MATSOLVERMUMPS;
}

}  // namespace

LinearSolver::LinearSolver(Mat matrix, const std::string& package) : package_(package) {
  MPI_Comm comm = PETSC_COMM_SELF;
  check_petsc(PetscObjectGetComm(reinterpret_cast<PetscObject>(matrix), &comm));
  int size = 1;
  MPI_Comm_size(comm, &size);
  sequential_ = size == 1;
  PetscInt rows = 0;
  check_petsc(MatGetSize(matrix, &rows, nullptr));
  if (package_ == "AUTO") package_ = rows <= most_for_klu ? "KLU" : "MUMPS";
  if (!sequential_) package_ = "MUMPS";
  if (package_ == "KLU") klu_ = std::make_unique<Klu>(matrix);
  check_petsc(KSPCreate(comm, ksp_.out()));
  check_petsc(KSPSetOperators(ksp_, matrix, matrix));
  check_petsc(KSPSetType(ksp_, KSPPREONLY));
  set_up();
}

void LinearSolver::set_up() {
  PC pc = nullptr;
  check_petsc(KSPGetPC(ksp_, &pc));
  if (klu_) {
    klu_->serve(pc);
    check_petsc(KSPSetFromOptions(ksp_));
    return;
  }
  check_petsc(PCSetType(pc, PCLU));
  check_petsc(PCFactorSetMatSolverType(pc, petsc_name(package_)));
  check_petsc(PCFactorSetUpMatSolverType(pc));
  // MUMPS stops with -9 when pivoting needs more room than the analysis guessed
  if (package_ == "MUMPS") check_petsc(MatMumpsSetIcntl(factor(), 14, mumps_room_));
  check_petsc(KSPSetFromOptions(ksp_));
}

Mat LinearSolver::matrix() const {
  Mat matrix = nullptr;
  check_petsc(KSPGetOperators(ksp_, &matrix, nullptr));
  return matrix;
}

std::vector<double> LinearSolver::values() const {
  const PetscScalar* values = nullptr;
  MatInfo info{};
  check_petsc(MatGetInfo(matrix(), MAT_LOCAL, &info));
  check_petsc(MatSeqAIJGetArrayRead(matrix(), &values));
  std::vector<double> all(values, values + static_cast<std::ptrdiff_t>(info.nz_used));
  check_petsc(MatSeqAIJRestoreArrayRead(matrix(), &values));
  return all;
}

bool LinearSolver::set_values(const std::vector<double>& values) {
  MatInfo info{};
  check_petsc(MatGetInfo(matrix(), MAT_LOCAL, &info));
  if (values.empty() || values.size() != static_cast<std::size_t>(info.nz_used)) return false;
  PetscScalar* into = nullptr;
  check_petsc(MatSeqAIJGetArray(matrix(), &into));
  std::copy(values.begin(), values.end(), into);
  check_petsc(MatSeqAIJRestoreArray(matrix(), &into));
  return true;
}

void LinearSolver::note_matrix() {
  if (!klu_ && sequential_ && analysed_for_.empty()) analysed_for_ = values();
}

void LinearSolver::save(Snapshot& snapshot) const {
  if (klu_)
    klu_->save(snapshot);
  else if (sequential_)
    snapshot.put("solver/" + package_, analysed_for_);
}

void LinearSolver::load(const Snapshot& snapshot) {
  if (klu_) {
    if (snapshot.has("klu/chosen_for")) klu_->load(snapshot);
    return;
  }
  // another package or another number of ranks: there is nothing to take over
  if (!sequential_ || !snapshot.has("solver/" + package_)) return;
  const std::vector<double>& values = snapshot.array("solver/" + package_);
  if (!set_values(values)) return;
  analysed_for_ = values;
  check_petsc(KSPSetUp(ksp_));
}

void LinearSolver::save_factors(Snapshot& snapshot) const {
  if (sequential_) snapshot.put("factors/" + package_, values());
}

bool LinearSolver::load_factors(const Snapshot& snapshot) {
  const std::string name = "factors/" + package_;
  if (!sequential_ || !snapshot.has(name) || !set_values(snapshot.array(name))) return false;
  restore_factors();
  return true;
}

void LinearSolver::restore_factors() {
  if (klu_) klu_->restore_factors();
  check_petsc(KSPSetUp(ksp_));
}

LinearSolver::Work LinearSolver::work() const {
  // counted for chains of 3, 20 and 100 links (docs/decisions/0024-kept-factors.md)
  if (klu_) return {9 * klu_->operations() + 25 * klu_->entries(), 9 * klu_->entries()};
  if (package_ == "MUMPS") {
    PetscInt entries = 0;
    check_petsc(MatMumpsGetInfog(factor(), 29, &entries));  // negative: in millions
    const double count = entries < 0 ? -1e6 * static_cast<double>(entries) : static_cast<double>(entries);
    return {3.1e5 + 408 * count, 4.6e5 + 43 * count};
  }
  PetscInt rows = 0;
  check_petsc(MatGetSize(matrix(), &rows, nullptr));
  const double n = static_cast<double>(rows);
  return package_ == "UMFPACK" ? Work{11300 * n, 420 * n} : Work{7500 * n, 530 * n};
}

void LinearSolver::reset() {
  Mat matrix = this->matrix();
  PC pc = nullptr;
  analysed_for_.clear();
  check_petsc(KSPGetPC(ksp_, &pc));
  check_petsc(PetscObjectReference(reinterpret_cast<PetscObject>(matrix)));
  check_petsc(PCReset(pc));
  if (klu_) klu_->forget();
  check_petsc(KSPSetOperators(ksp_, matrix, matrix));
  check_petsc(PetscObjectDereference(reinterpret_cast<PetscObject>(matrix)));
  set_up();
}

Mat LinearSolver::factor() const {
  PC pc = nullptr;
  Mat f = nullptr;
  check_petsc(KSPGetPC(ksp_, &pc));
  check_petsc(PCFactorGetMatrix(pc, &f));
  return f;
}

bool LinearSolver::solve(Vec right, Vec solution) {
  note_matrix();
  correct_only(false);
  do {
    check_petsc(KSPSolve(ksp_, right, solution));
    KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
    check_petsc(KSPGetConvergedReason(ksp_, &reason));
    PetscReal norm = 0;
    check_petsc(VecNorm(solution, NORM_INFINITY, &norm));
    if (reason > 0 && std::isfinite(norm)) return true;
  } while (enlarge());
  reset();
  return false;
}

bool LinearSolver::enlarge() {
  if (package_ != "MUMPS") return false;
  PetscInt info = 0;
  check_petsc(MatMumpsGetInfog(factor(), 1, &info));
  const bool short_of_room = info == -9 || info == -8 || info == -14 || info == -15;
  if (!short_of_room || mumps_room_ > 3000) return false;
  mumps_room_ *= 4;
  check_petsc(MatMumpsSetIcntl(factor(), 14, mumps_room_));
  return true;
}

double LinearSolver::factor_bytes() const {
  if (klu_) return klu_->bytes();
  MatInfo info{};
  if (package_ == "MUMPS") {
    PetscInt megabytes = 0;
    check_petsc(MatMumpsGetInfog(factor(), 19, &megabytes));  // total over all ranks, in the factorisation
    return 1e6 * static_cast<double>(megabytes);
  }
  check_petsc(MatGetInfo(factor(), MAT_GLOBAL_SUM, &info));
  return info.nz_used * (sizeof(PetscScalar) + sizeof(PetscInt));
}

}  // namespace engrane::solve
