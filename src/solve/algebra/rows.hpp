// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "assembly/petsc.hpp"

namespace engrane::solve {

/// The ranks that share a matrix, and its rows on all of them.
MPI_Comm comm_of(Mat matrix);
PetscInt rows_of(Mat matrix);

/// Whether a matrix is that of one rank, whose rows Rows shows.
bool is_sequential(Mat matrix);
/// Whether it is a symmetric one of which only the diagonal and what is above it are kept (Scatter).
bool is_half(Mat matrix);
/// The entries of a sequential matrix, and the other way round: false where there are not as many.
std::vector<double> values_of(Mat matrix);
bool set_values(Mat matrix, const std::vector<double>& values);

/// The rows of a sequential matrix, as far as they are kept, for as long as this lives. Its values must not be changed meanwhile.
class Rows {
 public:
  explicit Rows(Mat matrix);
  ~Rows();
  Rows(const Rows&) = delete;
  Rows& operator=(const Rows&) = delete;

  PetscInt size() const { return size_; }
  bool half() const { return half_; }  ///< rows begin with the diagonal
  PetscInt entries() const { return begin_[size_]; }
  const PetscInt* begin() const { return begin_; }  ///< of each row in column() and value(), and the end of the last
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
