// SPDX-License-Identifier: BSD-3-Clause
#include "solve/algebra/package_factors.hpp"

#include <algorithm>
#include <utility>

#include "solve/algebra/klu.hpp"
#include "solve/algebra/rows.hpp"
#include "solve/algebra/solver_cost.hpp"

namespace engrane::solve {

namespace {

constexpr int most_room = 3000;  ///< per cent over MUMPS' estimate

MatSolverType petsc_name(const std::string& package) {
  if (package == "UMFPACK") return MATSOLVERUMFPACK;
  if (package == "SUPERLU") return MATSOLVERSUPERLU;
  return MATSOLVERMUMPS;
}

}  // namespace

std::unique_ptr<Factors> make_factors(Mat matrix, const std::string& package) {
  if (package == "KLU") return std::make_unique<Klu>(matrix);
  return std::make_unique<PackageFactors>(matrix, package);
}

PackageFactors::PackageFactors(Mat matrix, std::string package)
    : matrix_(matrix), package_(std::move(package)), sequential_(is_sequential(matrix)) {}

bool PackageFactors::failed() const {
  MatFactorError error = MAT_FACTOR_NOERROR;
  check_petsc(MatFactorGetError(factors_, &error));
  return error != MAT_FACTOR_NOERROR;
}

bool PackageFactors::analyse() {
  if (factors_) return true;
  if (sequential_) analysed_for_ = values_of(matrix_);
  check_petsc(MatGetFactor(matrix_, petsc_name(package_), MAT_FACTOR_LU, factors_.out()));
  if (mumps()) check_petsc(MatMumpsSetIcntl(factors_, 14, room_));
  MatFactorInfo info;
  check_petsc(MatFactorInfoInitialize(&info));
  check_petsc(MatLUFactorSymbolic(factors_, matrix_, nullptr, nullptr, &info));
  return !failed();
}

bool PackageFactors::factor() {
  bool again = analyse();
  MatFactorInfo info;
  check_petsc(MatFactorInfoInitialize(&info));
  while (again) {
    check_petsc(MatFactorClearError(factors_));
    check_petsc(MatLUFactorNumeric(factors_, matrix_, &info));
    if (!failed()) return true;
    again = enlarge();
  }
  forget();  // MUMPS does not factor again after a failure
  return false;
}

bool PackageFactors::enlarge() {
  if (!mumps()) return false;
  PetscInt info = 0;
  check_petsc(MatMumpsGetInfog(factors_, 1, &info));
  const bool short_of_room = info == -9 || info == -8 || info == -14 || info == -15;
  if (!short_of_room || room_ > most_room) return false;
  room_ *= 4;
  check_petsc(MatMumpsSetIcntl(factors_, 14, room_));
  return true;
}

void PackageFactors::forget() {
  factors_ = {};
  analysed_for_.clear();
}

void PackageFactors::save(Snapshot& snapshot) const {
  if (sequential_) snapshot.put("solver/" + package_, factors_ ? analysed_for_ : std::vector<double>());
}

void PackageFactors::load(const Snapshot& snapshot) {
  // another package or another number of ranks: there is nothing to take over
  if (!sequential_ || !snapshot.has("solver/" + package_)) return;
  forget();
  const std::vector<double>& values = snapshot.array("solver/" + package_);
  if (!values.empty() && set_values(matrix_, values)) factor();
}

SolverWork PackageFactors::work() const {
  if (!factors_) return {};
  PetscInt rows = 0;
  check_petsc(MatGetSize(matrix_, &rows, nullptr));
  const auto n = static_cast<double>(rows);
  if (package_ == "UMFPACK") return {11300 * n, 420 * n};
  if (package_ == "SUPERLU") return {7500 * n, 530 * n};
  PetscInt entries = 0;
  PetscReal operations = 0;
  check_petsc(MatMumpsGetInfog(factors_, 29, &entries));  // negative: in millions
  check_petsc(MatMumpsGetRinfog(factors_, 3, &operations));
  return mumps_work(n, (entries < 0 ? -1e6 : 1) * static_cast<double>(entries), operations);
}

double PackageFactors::bytes() const {
  if (!factors_) return 0;
  if (mumps()) {
    PetscInt megabytes = 0;
    check_petsc(MatMumpsGetInfog(factors_, 19, &megabytes));  // total over all ranks, in the factorisation
    return 1e6 * static_cast<double>(megabytes);
  }
  MatInfo info{};
  check_petsc(MatGetInfo(factors_, MAT_GLOBAL_SUM, &info));
  return info.nz_used * (sizeof(PetscScalar) + sizeof(PetscInt));
}

}  // namespace engrane::solve
