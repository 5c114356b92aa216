// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "assembly/numbering.hpp"
#include "assembly/petsc.hpp"

namespace engrane {

/// Where the entries of each element's tangent and residual go: straight into the arrays of matrix and vector. The columns of an
/// element are runs of consecutive equations, so that a position for each row and run is all that is kept (56 bytes for a
/// spring). Rows of other ranks are left out: these evaluate the element too (Numbering::evaluated), so that nothing is sent.
class Scatter {
 public:
  /// For the elements of Numbering::evaluated(); collective. `half`, on one rank: of a matrix that is symmetric whatever the
  /// state, only the diagonal and what is above it are kept (MATSEQSBAIJ).
  Scatter(const Numbering& numbering, MPI_Comm comm, bool half = false);

  /// Columns of this rank's equations, and of all others; with one rank all are its own. `global` numbers the others' columns.
  struct Pieces {
    Mat own = nullptr, others = nullptr;
    const PetscInt* global = nullptr;
  };

  /// A matrix with a place for every pair of equations that share an element, and for every diagonal entry: factorisations
  /// expect those, projections write them.
  Mat matrix() const { return matrix_; }
  /// Another one like it. The caller owns it.
  Mat new_matrix() const;
  Vec new_vector() const;
  bool half() const { return half_; }

  /// Sums into matrix() or a matrix of new_matrix(), from zero; finish() (collective) must be called once all is added.
  class MatrixSum {
   public:
    MatrixSum(Scatter& scatter, Mat matrix);
    ~MatrixSum();
    MatrixSum(const MatrixSum&) = delete;
    MatrixSum& operator=(const MatrixSum&) = delete;

    /// Adds the tangent of an element, number `at` of Numbering::evaluated(): row-major, as wide as its slots.
    void add(std::size_t at, std::span<const double> k);
    /// Adds to a diagonal entry of this rank; after the elements.
    void add_diagonal(PetscInt row, double value);
    void finish();

   private:
    void add_half(std::size_t at, std::span<const double> k);
    void leave_arrays();
    const Scatter& scatter_;
    Mat matrix_;
    Pieces pieces_;
    PetscScalar *own_ = nullptr, *others_ = nullptr;  ///< values of the pieces, while elements are added
    bool left_ = false;
  };

  /// The same for a vector of new_vector(), without finish().
  class VectorSum {
   public:
    VectorSum(const Scatter& scatter, Vec vector);
    ~VectorSum();
    VectorSum(const VectorSum&) = delete;
    VectorSum& operator=(const VectorSum&) = delete;

    void add(int row, double value) {
      if (numbering_.is_own(row)) values_[row - numbering_.first_row()] += value;
    }

   private:
    const Numbering& numbering_;
    Vec vector_;
    PetscScalar* values_ = nullptr;
  };

  /// Forgets where entries go until they are summed again, which finds it anew: for matrices that are made once.
  void forget_places();

  /// Bytes that this keeps for the elements.
  std::size_t bytes() const;

 private:
  struct Run {
    int first, length;  ///< local slots with consecutive equations, all of this rank or none
  };
  struct Begin {
    std::size_t run, place;
    bool whole;  ///< no row is of another rank
  };
  void find_pattern();
  void preallocate(const std::vector<PetscInt>& row_begin, std::vector<PetscInt>& columns);
  void find_runs(int part);
  void find_places();

  const Numbering& numbering_;
  MPI_Comm comm_;
  int size_ = 1;
  bool half_ = false;
  Owned<Mat> matrix_;
  std::vector<Begin> begin_;
  std::vector<Run> runs_;
  std::vector<PetscInt> places_;  ///< in the values of the own columns, or −1 less than that in those of the others
};

}  // namespace engrane
