// SPDX-License-Identifier: BSD-3-Clause
#include "solve/algebra/rows.hpp"

#include <algorithm>

namespace engrane::solve {

bool is_sequential(Mat matrix) {
  PetscBool sequential = PETSC_FALSE;
  check_petsc(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(matrix), MATSEQAIJ, &sequential));
  return sequential == PETSC_TRUE;
}

std::vector<double> values_of(Mat matrix) {
  const Rows rows(matrix);
  return {rows.value(), rows.value() + rows.entries()};
}

bool set_values(Mat matrix, const std::vector<double>& values) {
  if (values.size() != static_cast<std::size_t>(Rows(matrix).entries())) return false;
  PetscScalar* into = nullptr;
  check_petsc(MatSeqAIJGetArray(matrix, &into));
  std::copy(values.begin(), values.end(), into);
  check_petsc(MatSeqAIJRestoreArray(matrix, &into));
  return true;
}

}  // namespace engrane::solve
