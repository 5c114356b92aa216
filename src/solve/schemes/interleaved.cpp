// SPDX-License-Identifier: BSD-3-Clause
#include "solve/schemes/interleaved.hpp"

#include <algorithm>

#include "solve/algebra/rows.hpp"

namespace engrane::solve {

namespace {

/// Entries of a vector on this rank, for the lifetime of this object.
class Local {
 public:
  explicit Local(Vec vector) : vector_(vector) {
    check_petsc(VecGetArray(vector, &values_));
    check_petsc(VecGetLocalSize(vector, &size_));
  }
  ~Local() { (void)VecRestoreArray(vector_, &values_); }
  Local(const Local&) = delete;
  Local& operator=(const Local&) = delete;
  double& operator[](PetscInt i) const { return values_[i]; }
  PetscInt size() const { return size_; }

 private:
  Vec vector_;
  PetscScalar* values_ = nullptr;
  PetscInt size_ = 0;
};

void insert_parts(std::span<const PetscInt> from, int parts, std::vector<PetscInt>& columns) {
  for (const PetscInt column : from)
    for (int part = 0; part < parts; ++part) columns.push_back(parts * column + part);
}

}  // namespace

Mat new_interleaved_matrix(Mat one, int parts) {
  PetscInt first = 0, end = 0;
  check_petsc(MatGetOwnershipRange(one, &first, &end));
  std::vector<PetscInt> begin{0}, columns;
  for (PetscInt row = first; row < end; ++row) {
    PetscInt count = 0;
    const PetscInt* from = nullptr;
    check_petsc(MatGetRow(one, row, &count, &from, nullptr));
    for (int part = 0; part < parts; ++part) {
      insert_parts({from, static_cast<std::size_t>(count)}, parts, columns);
      begin.push_back(static_cast<PetscInt>(columns.size()));
    }
    check_petsc(MatRestoreRow(one, row, &count, &from, nullptr));
  }
  Mat matrix = nullptr;
  check_petsc(MatCreate(comm_of(one), &matrix));
  check_petsc(MatSetSizes(matrix, parts * (end - first), parts * (end - first), parts * rows_of(one), parts * rows_of(one)));
  check_petsc(MatSetType(matrix, MATAIJ));
  // the call that does not match the matrix type does nothing
  check_petsc(MatSeqAIJSetPreallocationCSR(matrix, begin.data(), columns.data(), nullptr));
  check_petsc(MatMPIAIJSetPreallocationCSR(matrix, begin.data(), columns.data(), nullptr));
  return matrix;
}

InterleavedRows::InterleavedRows(Mat whole, int parts) : whole_(whole), parts_(parts) {
  if (is_sequential(whole)) check_petsc(MatSeqAIJGetArray(whole, &next_));
}

void InterleavedRows::write(PetscInt row, int part, std::span<const PetscInt> columns, std::span<const double> values) {
  if (next_) {
    next_ = std::copy(values.begin(), values.end(), next_);
    return;
  }
  columns_.clear();
  insert_parts(columns, parts_, columns_);
  const PetscInt into = parts_ * row + part;
  check_petsc(
      MatSetValues(whole_, 1, &into, static_cast<PetscInt>(columns_.size()), columns_.data(), values.data(), INSERT_VALUES));
}

void InterleavedRows::finish() {
  if (next_) {
    next_ = nullptr;  // PETSc takes back its own array, whatever is passed
    check_petsc(MatSeqAIJRestoreArray(whole_, &next_));
  }
  check_petsc(MatAssemblyBegin(whole_, MAT_FINAL_ASSEMBLY));
  check_petsc(MatAssemblyEnd(whole_, MAT_FINAL_ASSEMBLY));
}

void interleave(std::span<const Vec> ones, Vec whole) {
  const Local into(whole);
  const auto parts = static_cast<PetscInt>(ones.size());
  for (PetscInt part = 0; part < parts; ++part) {
    const Local one(ones[static_cast<std::size_t>(part)]);
    for (PetscInt i = 0; i < one.size(); ++i) into[parts * i + part] = one[i];
  }
}

void separate(Vec whole, std::span<const Vec> ones) {
  const Local from(whole);
  const auto parts = static_cast<PetscInt>(ones.size());
  for (PetscInt part = 0; part < parts; ++part) {
    const Local one(ones[static_cast<std::size_t>(part)]);
    for (PetscInt i = 0; i < one.size(); ++i) one[i] = from[parts * i + part];
  }
}

}  // namespace engrane::solve
