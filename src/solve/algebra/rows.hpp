// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "assembly/petsc.hpp"

namespace engrane::solve {

/// Communicator of a matrix, and its number of rows on all ranks.
MPI_Comm comm_of(Mat matrix);
PetscInt rows_of(Mat matrix);

/// Whether a matrix is stored on one rank, so that Rows can show it.
bool is_sequential(Mat matrix);
/// Whether only the diagonal and the upper triangle of a symmetric matrix are stored (Scatter).
bool is_half(Mat matrix);
/// Number of stored entries of each row of this rank.
std::vector<PetscInt> lengths_of_rows(Mat matrix);
/// Reads and writes the entries of a sequential matrix; set_values() returns false if their number differs.
std::vector<double> values_of(Mat matrix);
bool set_values(Mat matrix, const std::vector<double>& values);

/// Stored rows of a sequential matrix, for the lifetime of this object. The matrix must not be changed meanwhile.
class Rows {
 public:
  explicit Rows(Mat matrix);
  ~Rows();
  Rows(const Rows&) = delete;
  Rows& operator=(const Rows&) = delete;

  PetscInt size() const { return size_; }
  bool half() const { return half_; }  ///< rows begin with the diagonal
  PetscInt entries() const { return begin_[size_]; }
  const PetscInt* begin() const { return begin_; }  ///< offset of each row in column() and value(), then the end of the last
  const PetscInt* column() const { return column_; }
  const PetscScalar* value() const { return value_; }

 private:
  Mat matrix_;
  bool half_;
  PetscInt size_ = 0;
  const PetscInt *begin_ = nullptr, *column_ = nullptr;
  const PetscScalar* value_ = nullptr;
};

/// |A| x for this rank's rows of a matrix; `x` has an entry for each column.
std::vector<double> magnitudes_times(Mat matrix, std::span<const double> x);

}  // namespace engrane::solve
