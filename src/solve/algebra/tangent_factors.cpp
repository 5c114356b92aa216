// SPDX-License-Identifier: BSD-3-Clause
#include "solve/algebra/tangent_factors.hpp"

#include "solve/algebra/mumps_analysis.hpp"

namespace engrane::solve {

namespace {

/// Largest asymmetry that unbalanced forces at an equilibrium cause, relative to the largest entry of a row.
constexpr double unbalanced = 1e-6;
/// MUMPS' workspace for pivots that are not where the analysis expects them, per cent above the estimate.
constexpr int first_room = 50, most_room = 5000;

}  // namespace

bool TangentFactors::factor() {
  is_symmetric_ = symmetry_.symmetric(unbalanced);
  if (is_symmetric_) check_petsc(MatSetOption(matrix_, MAT_SPD, PETSC_FALSE));
  for (int room = first_room;; room *= 4) {
    analyse_for_mumps(matrix_, is_symmetric_, room, factors_, [this](Mat factors) {
      check_petsc(MatMumpsSetIcntl(factors, 13, 1));  // so that the pivots of the last block are counted, too
      if (!is_symmetric_) check_petsc(MatMumpsSetIcntl(factors, 33, 1));
    });
    MatFactorInfo info;
    check_petsc(MatFactorInfoInitialize(&info));
    check_petsc(is_symmetric_ ? MatCholeskyFactorNumeric(factors_, matrix_, &info)
                              : MatLUFactorNumeric(factors_, matrix_, &info));
    MatFactorError error = MAT_FACTOR_NOERROR;
    check_petsc(MatFactorGetError(factors_, &error));
    if (error == MAT_FACTOR_NOERROR) break;
    PetscInt code = 0;
    check_petsc(MatMumpsGetInfog(factors_, 1, &code));
    const bool short_of_room = code == -8 || code == -9 || code == -14 || code == -15;
    if (!short_of_room || room > most_room) return false;
  }
  if (is_symmetric_) {
    PetscInt count = 0;
    check_petsc(MatMumpsGetInfog(factors_, 12, &count));
    negative_ = static_cast<int>(count);
  } else {
    PetscReal determinant = 0;  // but for a power of two
    check_petsc(MatMumpsGetRinfog(factors_, 12, &determinant));
    negative_ = determinant < 0 ? 1 : 0;
  }
  return true;
}

}  // namespace engrane::solve
