// SPDX-License-Identifier: BSD-3-Clause
#include "solve/algebra/rows.hpp"

#include <algorithm>
#include <cmath>

namespace engrane::solve {

MPI_Comm comm_of(Mat matrix) {
  MPI_Comm comm = PETSC_COMM_SELF;
  check_petsc(PetscObjectGetComm(reinterpret_cast<PetscObject>(matrix), &comm));
  return comm;
}

PetscInt rows_of(Mat matrix) {
  PetscInt rows = 0;
  check_petsc(MatGetSize(matrix, &rows, nullptr));
  return rows;
}

bool is_sequential(Mat matrix) {
  PetscBool sequential = PETSC_FALSE;
  check_petsc(PetscObjectTypeCompareAny(reinterpret_cast<PetscObject>(matrix), &sequential, MATSEQAIJ, MATSEQSBAIJ, ""));
  return sequential == PETSC_TRUE;
}

bool is_half(Mat matrix) {
  PetscBool half = PETSC_FALSE;
  check_petsc(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(matrix), MATSEQSBAIJ, &half));
  return half == PETSC_TRUE;
}

std::vector<PetscInt> lengths_of_rows(Mat matrix) {
  PetscInt first = 0, end = 0;
  check_petsc(MatGetOwnershipRange(matrix, &first, &end));
  std::vector<PetscInt> lengths(static_cast<std::size_t>(end - first), 0);
  if (is_sequential(matrix)) {
    const Rows rows(matrix);
    for (std::size_t row = 0; row < lengths.size(); ++row) lengths[row] = rows.begin()[row + 1] - rows.begin()[row];
    return lengths;
  }
  for (PetscInt row = first; row < end; ++row) {
    PetscInt& length = lengths[static_cast<std::size_t>(row - first)];
    check_petsc(MatGetRow(matrix, row, &length, nullptr, nullptr));
    PetscInt restored = length;
    check_petsc(MatRestoreRow(matrix, row, &restored, nullptr, nullptr));
  }
  return lengths;
}

std::vector<double> magnitudes_times(Mat matrix, std::span<const double> x) {
  PetscInt first = 0, end = 0;
  check_petsc(MatGetOwnershipRange(matrix, &first, &end));
  std::vector<double> sums(static_cast<std::size_t>(end - first), 0.0);
  const auto of = [&x](PetscInt column) { return x[static_cast<std::size_t>(column)]; };
  if (is_sequential(matrix)) {
    const Rows rows(matrix);
    for (PetscInt row = 0; row < end; ++row)
      for (PetscInt k = rows.begin()[row]; k < rows.begin()[row + 1]; ++k) {
        const double value = std::abs(rows.value()[k]);
        const PetscInt column = rows.column()[k];
        sums[static_cast<std::size_t>(row)] += value * of(column);
        if (rows.half() && column != row) sums[static_cast<std::size_t>(column)] += value * of(row);
      }
    return sums;
  }
  for (PetscInt row = first; row < end; ++row) {
    PetscInt count = 0;
    const PetscInt* column = nullptr;
    const PetscScalar* value = nullptr;
    check_petsc(MatGetRow(matrix, row, &count, &column, &value));
    for (PetscInt i = 0; i < count; ++i) sums[static_cast<std::size_t>(row - first)] += std::abs(value[i]) * of(column[i]);
    check_petsc(MatRestoreRow(matrix, row, &count, &column, &value));
  }
  return sums;
}

Rows::Rows(Mat matrix) : matrix_(matrix), half_(is_half(matrix)) {
  PetscBool done = PETSC_FALSE;
  check_petsc(MatGetRowIJ(matrix, 0, PETSC_FALSE, PETSC_FALSE, &size_, &begin_, &column_, &done));
  if (half_) {
    PetscScalar* values = nullptr;
    check_petsc(MatSeqSBAIJGetArray(matrix, &values));
    value_ = values;
  } else {
    check_petsc(MatSeqAIJGetArrayRead(matrix, &value_));
  }
}

Rows::~Rows() {
  PetscBool done = PETSC_FALSE;
  if (half_) {
    auto* values = const_cast<PetscScalar*>(value_);
    (void)MatSeqSBAIJRestoreArray(matrix_, &values);
  } else {
    (void)MatSeqAIJRestoreArrayRead(matrix_, &value_);
  }
  (void)MatRestoreRowIJ(matrix_, 0, PETSC_FALSE, PETSC_FALSE, &size_, &begin_, &column_, &done);
}

std::vector<double> values_of(Mat matrix) {
  const Rows rows(matrix);
  return {rows.value(), rows.value() + rows.entries()};
}

bool set_values(Mat matrix, const std::vector<double>& values) {
  if (values.size() != static_cast<std::size_t>(Rows(matrix).entries())) return false;
  PetscScalar* into = nullptr;
  const bool half = is_half(matrix);
  check_petsc(half ? MatSeqSBAIJGetArray(matrix, &into) : MatSeqAIJGetArray(matrix, &into));
  std::copy(values.begin(), values.end(), into);
  check_petsc(half ? MatSeqSBAIJRestoreArray(matrix, &into) : MatSeqAIJRestoreArray(matrix, &into));
  return true;
}

}  // namespace engrane::solve
