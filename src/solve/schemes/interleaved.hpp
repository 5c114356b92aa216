// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "assembly/petsc.hpp"

namespace engrane::solve {

/// A matrix of several times the rows and columns of `one`: those parts·i to parts·i + parts − 1 stand for its row or column i,
/// and where it has an entry the matrix has parts × parts of them. Ranks share both in the same way.
Mat new_interleaved_matrix(Mat one, int parts);

/// Writes the rows of such a matrix, each of this rank once and in their order.
class InterleavedRows {
 public:
  InterleavedRows(Mat whole, int parts);

  /// Part `part` of row `row`: `parts` values for each of the columns of `one` in that row.
  void write(PetscInt row, int part, std::span<const PetscInt> columns, std::span<const double> values);
  /// After the last row.
  void finish();

 private:
  Mat whole_;
  int parts_;
  PetscScalar* next_ = nullptr;  ///< where the next row begins in a matrix of one rank
  std::vector<PetscInt> columns_;
};

/// The values of `ones`, one of each in turn, as `whole`; and back.
void interleave(std::span<const Vec> ones, Vec whole);
void separate(Vec whole, std::span<const Vec> ones);

}  // namespace engrane::solve
