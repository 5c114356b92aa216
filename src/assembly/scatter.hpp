// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "assembly/numbering.hpp"
#include "assembly/petsc.hpp"

namespace engrane {

/// Where the entries of each element's tangent and residual go. On one rank they are added straight into the arrays of matrix
/// and vector: the columns of an element are runs of consecutive equations, so that a position for each row and run is all
/// that is kept (48 bytes for a spring). On several ranks PETSc finds the places and carries them to their owners.
class Scatter {
 public:
  /// For the elements `first_part` to `end_part`; collective.
  Scatter(const Numbering& numbering, int first_part, int end_part, MPI_Comm comm);

  /// A matrix with a place for every pair of equations that share an element, and for every diagonal entry: factorisations
  /// expect those, projections write them.
  Mat matrix() const { return matrix_; }
  /// Another one like it. The caller owns it.
  Mat new_matrix() const;
  Vec new_vector() const;

  /// Sums into matrix() or a matrix of new_matrix(), from zero; finish() (collective) must be called once all is added.
  class MatrixSum {
   public:
    MatrixSum(const Scatter& scatter, Mat matrix);
    ~MatrixSum();
    MatrixSum(const MatrixSum&) = delete;
    MatrixSum& operator=(const MatrixSum&) = delete;

    /// Adds an element's tangent: row-major, as wide as its slots.
    void add(int part, std::span<const double> k);
    /// Adds to a diagonal entry of this rank; after the elements.
    void add_diagonal(PetscInt row, double value);
    void finish();

   private:
    void leave_array();
    const Scatter& scatter_;
    Mat matrix_;
    PetscScalar* values_ = nullptr;  ///< of the matrix, while elements are added on one rank
  };

  /// The same for a vector of new_vector().
  class VectorSum {
   public:
    VectorSum(const Scatter& scatter, Vec vector);
    ~VectorSum();
    VectorSum(const VectorSum&) = delete;
    VectorSum& operator=(const VectorSum&) = delete;

    void add(PetscInt row, double value) {
      if (values_)
        values_[row] += value;
      else
        check_petsc(VecSetValue(vector_, row, value, ADD_VALUES));
    }
    void finish();

   private:
    Vec vector_;
    PetscScalar* values_ = nullptr;
  };

  PetscInt first_row() const { return first_row_; }
  PetscInt end_row() const { return end_row_; }
  /// Bytes that this keeps for the elements.
  std::size_t bytes() const;

 private:
  struct Run {
    int first, length;  ///< local slots with consecutive equations
  };
  struct Begin {
    std::size_t run, place;
  };
  void find_pattern();
  void find_places();

  const Numbering& numbering_;
  MPI_Comm comm_;
  int size_ = 1, first_part_, end_part_;
  PetscInt first_row_ = 0, end_row_ = 0;
  Owned<Mat> matrix_;
  std::vector<Begin> begin_;
  std::vector<Run> runs_;
  std::vector<PetscInt> places_;
};

}  // namespace engrane
