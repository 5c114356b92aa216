// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "assembly/petsc.hpp"

namespace engrane::solve {

/// Returns a matrix with `parts` times as many rows and columns as `one`: rows and columns parts·i to parts·i + parts − 1 stand
/// for row or column i, and each entry becomes a block of parts × parts. Ranks share both in the same way.
Mat new_interleaved_matrix(Mat one, int parts);

/// Writes the rows of such a matrix: each row of this rank once, in order.
class InterleavedRows {
 public:
  InterleavedRows(Mat whole, int parts);

  /// Writes part `part` of row `row`: `parts` values for each of the columns of `one` in that row.
  void write(PetscInt row, int part, std::span<const PetscInt> columns, std::span<const double> values);
  /// Call after the last row.
  void finish();

 private:
  Mat whole_;
  int parts_;
  PetscScalar* next_ = nullptr;  ///< start of the next row in a sequential matrix
  std::vector<PetscInt> columns_;
};

/// Interleaves the entries of `ones` in `whole`; separate() does the reverse.
void interleave(std::span<const Vec> ones, Vec whole);
void separate(Vec whole, std::span<const Vec> ones);

}  // namespace engrane::solve
