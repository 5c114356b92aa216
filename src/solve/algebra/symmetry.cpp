// SPDX-License-Identifier: BSD-3-Clause
#include "solve/algebra/symmetry.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "solve/algebra/probe.hpp"
#include "solve/algebra/rows.hpp"

namespace engrane::solve {

namespace {

constexpr double some_hundred = 300;  ///< terms of a sum, for whose rounding SymmetryTest::rounding stands

PetscInt local_size(Vec vector) {
  PetscInt size = 0;
  check_petsc(VecGetLocalSize(vector, &size));
  return size;
}

/// Whether `yes` holds on all ranks.
bool everywhere(bool yes, Mat matrix) {
  int all = yes ? 1 : 0;
  MPI_Allreduce(MPI_IN_PLACE, &all, 1, MPI_INT, MPI_LAND, comm_of(matrix));
  return all != 0;
}

}  // namespace

void SymmetryTest::prepare() {
  if (probe_) return;
  check_petsc(MatCreateVecs(matrix_, probe_.out(), product_.out()));
  check_petsc(VecDuplicate(product_, transposed_.out()));
  check_petsc(VecDuplicate(product_, largest_.out()));
  fill_probe(probe_);
}

void SymmetryTest::rest() {
  for (Owned<Vec>* vector : {&probe_, &product_, &transposed_, &largest_}) *vector = {};
}

bool SymmetryTest::symmetric(double part) {
  if (half_) return true;
  prepare();
  check_petsc(MatMult(matrix_, probe_, product_));
  check_petsc(MatMultTranspose(matrix_, probe_, transposed_));
  check_petsc(MatGetRowMaxAbs(matrix_, largest_, nullptr));
  const PetscScalar *ax = nullptr, *atx = nullptr, *largest = nullptr;
  check_petsc(VecGetArrayRead(product_, &ax));
  check_petsc(VecGetArrayRead(transposed_, &atx));
  check_petsc(VecGetArrayRead(largest_, &largest));
  const std::vector<PetscInt> lengths = lengths_of_rows(matrix_);
  bool same = true;
  for (PetscInt i = 0, n = local_size(product_); same && i < n; ++i) {
    const double share = std::max(1.0, static_cast<double>(lengths[static_cast<std::size_t>(i)]) / some_hundred);
    same = std::abs(ax[i] - atx[i]) <= std::max(part, rounding * share) * std::abs(largest[i]);
  }
  check_petsc(VecRestoreArrayRead(product_, &ax));
  check_petsc(VecRestoreArrayRead(transposed_, &atx));
  check_petsc(VecRestoreArrayRead(largest_, &largest));
  return everywhere(same, matrix_);
}

bool SymmetryTest::positive_diagonal() {
  Owned<Vec> diagonal;
  check_petsc(MatCreateVecs(matrix_, nullptr, diagonal.out()));
  check_petsc(MatGetDiagonal(matrix_, diagonal));
  const PetscScalar* d = nullptr;
  check_petsc(VecGetArrayRead(diagonal, &d));
  bool positive = true;
  for (PetscInt i = 0, n = local_size(diagonal); positive && i < n; ++i) positive = d[i] > 0;
  check_petsc(VecRestoreArrayRead(diagonal, &d));
  return everywhere(positive, matrix_);
}

}  // namespace engrane::solve
