// SPDX-License-Identifier: BSD-3-Clause
#include "solve/algebra/probe.hpp"

#include <cmath>
#include <limits>

namespace engrane::solve {

double probe_value(std::size_t place) {
  constexpr double golden = 0.61803398874989485;
  const double turns = golden * static_cast<double>(place + 1);
  return 0.5 + turns - std::floor(turns);
}

void fill_probe(Vec vector) {
  PetscInt first = 0, end = 0;
  PetscScalar* x = nullptr;
  check_petsc(VecGetOwnershipRange(vector, &first, &end));
  check_petsc(VecGetArrayWrite(vector, &x));
  for (PetscInt i = first; i < end; ++i) x[i - first] = probe_value(static_cast<std::size_t>(i));
  check_petsc(VecRestoreArrayWrite(vector, &x));
}

double relative_stiffness(Mat matrix, Vec motion, Vec load) {
  Owned<Vec> weighted;
  check_petsc(VecDuplicate(motion, weighted.out()));
  check_petsc(MatGetDiagonal(matrix, weighted));
  check_petsc(VecAbs(weighted));
  check_petsc(VecPointwiseMult(weighted, weighted, motion));
  PetscScalar energy = 0, size = 0;
  check_petsc(VecDot(motion, load, &energy));
  check_petsc(VecDot(motion, weighted, &size));
  return size > 0 ? std::abs(energy) / size : std::numeric_limits<double>::infinity();
}

}  // namespace engrane::solve
