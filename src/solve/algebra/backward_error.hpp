// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "assembly/numbering.hpp"
#include "assembly/petsc.hpp"

namespace engrane::solve {

/// Backward error of a solution that is as good as rounding allows: it solves a system that cannot be told from the given one.
inline constexpr double good_solution = 1e-14;
/// If neither a solution nor its refinement is this good, the factors have lost digits that others would keep. Rows whose terms
/// are at most this fraction of the largest of their kind are filled by the rounding of others.
inline constexpr double fair_solution = 1e-11;

/// Kind of each equation of the assembler: its Measure, or one more kind for signals. Rows of one kind have one unit.
std::vector<unsigned char> kinds_of_rows(const Numbering& numbering);

/// Row-wise backward error of a solution: the residual b − Ax over the sum of its terms, |A||x| + |b| (Oettli and Prager,
/// Numer. Math. 6 (1964) 405). Rows filled by the rounding of others, such as those of motions out of the plane of a mechanism,
/// are compared with the terms of the largest row of their kind (after Arioli, Demmel and Duff, SIAM J. Matrix Anal. Appl. 10
/// (1989) 165, section 2).
class BackwardError {
 public:
  /// `kinds`: kind, below 8, of each row of all ranks. If empty, every row is judged by its own terms.
  BackwardError(Mat matrix, const std::vector<unsigned char>& kinds);

  /// Returns the largest of all rows, the same on every rank; infinite if a term is not finite. Sets residual().
  double of(Vec right, Vec solution);
  Vec residual() const { return residual_; }

 private:
  /// Values of the ghost unknowns: those of other ranks that appear in this rank's rows. Null on one rank.
  const PetscScalar* fetch(Vec solution);
  double largest_of(const PetscScalar* remainder) const;

  Mat matrix_;
  MPI_Comm comm_ = MPI_COMM_NULL;
  bool parallel_ = false;
  /// Columns of this rank's unknowns, and of the ghost unknowns. A sequential matrix has own columns only.
  Mat own_ = nullptr, others_ = nullptr;
  Owned<Vec> residual_, ghosts_;
  Owned<VecScatter> gather_;
  std::vector<double> terms_;
  std::vector<unsigned char> kinds_;  ///< of this rank's rows; empty: not given
};

}  // namespace engrane::solve
