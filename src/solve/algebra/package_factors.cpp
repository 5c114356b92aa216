// SPDX-License-Identifier: BSD-3-Clause
#include "solve/algebra/package_factors.hpp"

#include <utility>

#include "solve/algebra/conjugate_gradients.hpp"
#include "solve/algebra/klu.hpp"
#include "solve/algebra/mumps.hpp"
#include "solve/algebra/rows.hpp"

namespace engrane::solve {

std::unique_ptr<Factors> make_factors(Mat matrix, const std::string& package) {
  if (package == "KLU") return std::make_unique<Klu>(matrix);
  if (package == "CG") return std::make_unique<ConjugateGradients>(matrix);
  if (package == "MUMPS" || package == "BLR") return std::make_unique<Mumps>(matrix, package == "BLR");
  return std::make_unique<PackageFactors>(matrix, package);
}

PackageFactors::PackageFactors(Mat matrix, std::string package)
    : matrix_(matrix), package_(std::move(package)), sequential_(is_sequential(matrix)) {}

bool PackageFactors::failed() const {
  MatFactorError error = MAT_FACTOR_NOERROR;
  check_petsc(MatFactorGetError(factors_, &error));
  return error != MAT_FACTOR_NOERROR;
}

void PackageFactors::note_analysed() {
  if (sequential_) analysed_for_ = values_of(matrix_);
}

bool PackageFactors::factor() {
  MatFactorInfo info;
  check_petsc(MatFactorInfoInitialize(&info));
  if (!factors_) {
    note_analysed();
    check_petsc(
        MatGetFactor(matrix_, package_ == "UMFPACK" ? MATSOLVERUMFPACK : MATSOLVERSUPERLU, MAT_FACTOR_LU, factors_.out()));
    check_petsc(MatLUFactorSymbolic(factors_, matrix_, nullptr, nullptr, &info));
  }
  if (!failed()) {
    check_petsc(MatLUFactorNumeric(factors_, matrix_, &info));
    if (!failed()) return true;
  }
  forget();
  return false;
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
  PackageFactors::forget();
  const std::vector<double>& values = snapshot.array("solver/" + package_);
  if (!values.empty() && set_values(matrix_, values)) factor();
}

SolverWork PackageFactors::work() const {
  if (!factors_) return {};
  const auto n = static_cast<double>(rows_of(matrix_));
  return package_ == "UMFPACK" ? SolverWork{11300 * n, 420 * n} : SolverWork{7500 * n, 530 * n};
}

double PackageFactors::bytes() const {
  if (!factors_) return 0;
  MatInfo info{};
  check_petsc(MatGetInfo(factors_, MAT_GLOBAL_SUM, &info));
  return info.nz_used * (sizeof(PetscScalar) + sizeof(PetscInt));
}

}  // namespace engrane::solve
