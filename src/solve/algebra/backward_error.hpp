// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "assembly/numbering.hpp"
#include "assembly/petsc.hpp"

namespace engrane::solve {

/// A solution with this backward error is that of a matrix that nobody can tell from the given one.
inline constexpr double good_solution = 1e-14;
/// Where neither a solution nor its refinement is as good as this, the factors have lost digits that others would keep. Rows
/// whose terms are this part of the largest of their kind hold rounding of others.
inline constexpr double fair_solution = 1e-11;

/// What each equation of the assembler is: those of one kind have one unit.
std::vector<unsigned char> kinds_of_rows(const Numbering& numbering);

/// How far a solution is from that of its system, row by row: the remainder b − Ax over the sum of its terms, |A||x| + |b|
/// (Oettli and Prager, Numer. Math. 6 (1964) 405). Rows that the rounding of others fills, as those of motions that lead out of
/// the plane of a mechanism, count by the terms of the largest row of their kind (after Arioli, Demmel and Duff, SIAM J. Matrix
/// Anal. Appl. 10 (1989) 165, section 2).
class BackwardError {
 public:
  /// `kinds`: fewer than 8, one for each row of all ranks. Without them every row is judged by its own terms.
  BackwardError(Mat matrix, const std::vector<unsigned char>& kinds);

  /// The largest of all rows, the same on every rank; infinite where something is not a number. The remainder goes to residual().
  double of(Vec right, Vec solution);
  Vec residual() const { return residual_; }

 private:
  /// Values of other ranks' unknowns that the rows of this one meet; null on one rank.
  const PetscScalar* fetch(Vec solution);
  double largest_of(const PetscScalar* remainder) const;

  Mat matrix_;
  MPI_Comm comm_ = MPI_COMM_NULL;
  bool parallel_ = false;
  /// Columns of this rank's unknowns and of others'; a sequential matrix is all own.
  Mat own_ = nullptr, others_ = nullptr;
  Owned<Vec> residual_, ghosts_;
  Owned<VecScatter> gather_;
  std::vector<double> terms_;
  std::vector<unsigned char> kinds_;  ///< of this rank's rows; empty: not told
};

}  // namespace engrane::solve
