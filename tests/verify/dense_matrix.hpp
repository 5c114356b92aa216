// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Dense>

#include "assembly/assembler.hpp"

namespace engrane::test {

/// The assembled matrix as a dense one; on one rank.
inline Eigen::MatrixXd dense(const Assembler& assembler) {
  const int n = assembler.numbering().equations();
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(n, n);
  for (PetscInt row = 0; row < n; ++row) {
    PetscInt count = 0;
    const PetscInt* columns = nullptr;
    const PetscScalar* values = nullptr;
    check_petsc(MatGetRow(assembler.matrix(), row, &count, &columns, &values));
    for (PetscInt i = 0; i < count; ++i) full(row, columns[i]) = values[i];
    check_petsc(MatRestoreRow(assembler.matrix(), row, &count, &columns, &values));
  }
  return full;
}

}  // namespace engrane::test
