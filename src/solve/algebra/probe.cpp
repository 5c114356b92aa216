// SPDX-License-Identifier: BSD-3-Clause
#include "solve/algebra/probe.hpp"

#include <cmath>

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

}  // namespace engrane::solve
