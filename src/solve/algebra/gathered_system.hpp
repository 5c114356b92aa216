// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "assembly/petsc.hpp"

namespace engrane::solve {

/// A linear system distributed over several ranks, gathered on the first of them. A small system is solved there, because the
/// messages of a package that solves it on all ranks would take longer than the solution. All functions are collective.
class GatheredSystem {
 public:
  /// `shared`: a matrix on several ranks with a complete sparsity pattern.
  explicit GatheredSystem(Mat shared);

  /// Whether this is the first rank, which has the matrix and the vectors below; others have none.
  bool here() const { return rank_ == 0; }
  Mat matrix() const { return matrix_; }
  Vec right() const { return right_; }
  Vec solution() const { return solution_; }

  /// Gathers the entries of the shared matrix as it stands.
  void fetch_matrix();
  /// Gathers a distributed vector into right().
  void fetch(Vec right);
  /// Scatters solution() to a distributed vector.
  void give(Vec solution) const;

 private:
  void gather_sizes(PetscInt rows, std::size_t entries);
  /// Makes the matrix of the first rank from the row and the column of every entry, in order of arrival.
  void make_matrix(const std::vector<PetscInt>& rows, const std::vector<PetscInt>& columns);

  Mat shared_;
  MPI_Comm comm_ = MPI_COMM_NULL;
  int rank_ = 0;
  Owned<Mat> matrix_;
  Owned<Vec> right_, solution_;
  std::vector<double> own_;  ///< entries of this rank: those within its own columns, then the others
  // on the first rank:
  std::vector<int> rows_of_, first_row_of_;       ///< each rank's rows
  std::vector<int> entries_of_, first_entry_of_;  ///< each rank's entries
  std::vector<double> arrived_;                   ///< all entries, rank by rank
  std::vector<PetscInt> place_;                   ///< position of each of these in matrix_
};

}  // namespace engrane::solve
