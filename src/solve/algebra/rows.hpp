// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "assembly/petsc.hpp"

namespace engrane::solve {

/// Whether a matrix is that of one rank, whose rows Rows shows.
bool is_sequential(Mat matrix);
/// The entries of a sequential matrix, and the other way round: false where there are not as many.
std::vector<double> values_of(Mat matrix);
bool set_values(Mat matrix, const std::vector<double>& values);

/// The rows of a sequential matrix, for as long as this lives. Its values must not be changed meanwhile.
class Rows {
 public:
  explicit Rows(Mat matrix) : matrix_(matrix) {
    PetscBool done = PETSC_FALSE;
    check_petsc(MatGetRowIJ(matrix, 0, PETSC_FALSE, PETSC_FALSE, &size_, &begin_, &column_, &done));
    check_petsc(MatSeqAIJGetArrayRead(matrix, &value_));
  }
  ~Rows() {
    PetscBool done = PETSC_FALSE;
    (void)MatSeqAIJRestoreArrayRead(matrix_, &value_);
    (void)MatRestoreRowIJ(matrix_, 0, PETSC_FALSE, PETSC_FALSE, &size_, &begin_, &column_, &done);
  }
  Rows(const Rows&) = delete;
  Rows& operator=(const Rows&) = delete;

  PetscInt size() const { return size_; }
  PetscInt entries() const { return begin_[size_]; }
  const PetscInt* begin() const { return begin_; }  ///< of each row in column() and value(), and the end of the last
  const PetscInt* column() const { return column_; }
  const PetscScalar* value() const { return value_; }

 private:
  Mat matrix_;
  PetscInt size_ = 0;
  const PetscInt *begin_ = nullptr, *column_ = nullptr;
  const PetscScalar* value_ = nullptr;
};

}  // namespace engrane::solve
