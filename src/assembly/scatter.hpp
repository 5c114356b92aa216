// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "assembly/numbering.hpp"
#include "assembly/petsc.hpp"

namespace engrane {

/// Positions of each element's tangent entries in the global matrix. Entries are added directly to the arrays of PETSc's
/// matrices and vectors. The columns of an element form runs of consecutive equations, so only one position per row and run is
/// stored (56 bytes for a spring). Rows of other ranks are skipped: those ranks evaluate the element too
/// (Numbering::evaluated), so nothing is communicated.
class Scatter {
 public:
  /// For the elements of Numbering::evaluated(). Collective. `half`, on one rank only: the matrix is symmetric in every state,
  /// and only the diagonal and the upper triangle are stored (MATSEQSBAIJ).
  Scatter(const Numbering& numbering, MPI_Comm comm, bool half = false);

  /// Diagonal block (`own`, columns of this rank's equations) and off-diagonal block (`others`) of a parallel matrix. On one
  /// rank, `own` is the whole matrix. `global` gives the global column numbers of `others`.
  struct Pieces {
    Mat own = nullptr, others = nullptr;
    const PetscInt* global = nullptr;
  };

  /// Matrix with an entry for every pair of equations that share an element, and for the whole diagonal, which factorisations
  /// expect and projections write.
  Mat matrix() const { return matrix_; }
  /// Returns a new matrix with the same structure. The caller owns it.
  Mat new_matrix() const;
  Vec new_vector() const;
  bool half() const { return half_; }

  /// Assembles into matrix() or a matrix from new_matrix(), starting from zero. Call finish() (collective) when everything is
  /// added.
  class MatrixSum {
   public:
    MatrixSum(Scatter& scatter, Mat matrix);
    ~MatrixSum();
    MatrixSum(const MatrixSum&) = delete;
    MatrixSum& operator=(const MatrixSum&) = delete;

    /// Adds the tangent of the element at index `at` of Numbering::evaluated(): row-major, with as many columns as the element
    /// has slots.
    void add(std::size_t at, std::span<const double> k);
    /// Adds to a diagonal entry of this rank. Call only after all elements have been added.
    void add_diagonal(PetscInt row, double value);
    void finish();

   private:
    void add_half(std::size_t at, std::span<const double> k);
    void leave_arrays();
    const Scatter& scatter_;
    Mat matrix_;
    Pieces pieces_;
    PetscScalar *own_ = nullptr, *others_ = nullptr;  ///< arrays of the two blocks while elements are added
    bool left_ = false;
  };

  /// Assembles a vector from new_vector(). Needs no finish().
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

  /// Frees the entry positions; the next assembly finds them again. For matrices that are assembled once.
  void forget_places();

  /// Memory used for the element tables, in bytes.
  std::size_t bytes() const;

 private:
  struct Run {
    int first, length;  ///< local slots with consecutive equations, all owned by this rank or none
  };
  struct Begin {
    std::size_t run, place;
    bool whole;  ///< this rank owns all rows
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
  std::vector<PetscInt> places_;  ///< index p ≥ 0 into the values of the own block, or −1 − p for the other block
};

}  // namespace engrane
