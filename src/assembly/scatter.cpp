// SPDX-License-Identifier: BSD-3-Clause
#include "assembly/scatter.hpp"

#include <algorithm>

namespace engrane {

Scatter::Scatter(const Numbering& numbering, int first_part, int end_part, MPI_Comm comm)
    : numbering_(numbering), comm_(comm), first_part_(first_part), end_part_(end_part) {
  MPI_Comm_size(comm, &size_);
  find_pattern();
  if (size_ == 1) find_places();
}

void Scatter::find_pattern() {
  const int n = numbering_.equations();
  check_petsc(MatCreate(comm_, matrix_.out()));
  check_petsc(MatSetSizes(matrix_, PETSC_DECIDE, PETSC_DECIDE, n, n));
  check_petsc(MatSetType(matrix_, MATAIJ));
  check_petsc(MatSetFromOptions(matrix_));
  PetscLayout rows_of_ranks = nullptr, columns_of_ranks = nullptr;
  check_petsc(MatGetLayouts(matrix_, &rows_of_ranks, &columns_of_ranks));
  check_petsc(PetscLayoutSetUp(rows_of_ranks));
  check_petsc(PetscLayoutSetUp(columns_of_ranks));
  check_petsc(PetscLayoutGetRange(rows_of_ranks, &first_row_, &end_row_));

  // the elements of each row; every rank knows all elements, and so the whole of its own rows
  const auto rows = static_cast<std::size_t>(end_row_ - first_row_);
  std::vector<std::size_t> begin(rows + 1, 0);
  const auto for_each_row = [&](auto&& use) {
    for (int p = 0; p < numbering_.parts(); ++p)
      for (const int slot : numbering_.part_slots(p))
        if (const PetscInt row = numbering_.equation(slot); row >= first_row_ && row < end_row_)
          use(p, static_cast<std::size_t>(row - first_row_));
  };
  for_each_row([&](int, std::size_t row) { ++begin[row + 1]; });
  for (std::size_t row = 0; row < rows; ++row) begin[row + 1] += begin[row];
  std::vector<int> parts(begin[rows]);
  std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
  for_each_row([&](int part, std::size_t row) { parts[next[row]++] = part; });

  std::vector<PetscInt> row_begin{0}, columns, seen(static_cast<std::size_t>(n), -1);
  row_begin.reserve(rows + 1);
  for (std::size_t row = 0; row < rows; ++row) {
    const PetscInt own = first_row_ + static_cast<PetscInt>(row);
    const auto first = static_cast<std::ptrdiff_t>(columns.size());
    const auto add = [&](PetscInt column) {
      if (column < 0 || seen[static_cast<std::size_t>(column)] == own) return;
      seen[static_cast<std::size_t>(column)] = own;
      columns.push_back(column);
    };
    add(own);
    for (std::size_t e = begin[row]; e < begin[row + 1]; ++e)
      for (const int slot : numbering_.part_slots(parts[e])) add(numbering_.equation(slot));
    std::sort(columns.begin() + first, columns.end());
    row_begin.push_back(static_cast<PetscInt>(columns.size()));
  }
  // of the two the one that is not of the matrix's type does nothing
  check_petsc(MatSeqAIJSetPreallocationCSR(matrix_, row_begin.data(), columns.data(), nullptr));
  check_petsc(MatMPIAIJSetPreallocationCSR(matrix_, row_begin.data(), columns.data(), nullptr));
  check_petsc(MatSetOption(matrix_, MAT_NEW_NONZERO_LOCATION_ERR, PETSC_TRUE));
}

void Scatter::find_places() {
  const PetscInt *row_begin = nullptr, *columns = nullptr;
  PetscInt rows = 0;
  PetscBool done = PETSC_FALSE;
  check_petsc(MatGetRowIJ(matrix_, 0, PETSC_FALSE, PETSC_FALSE, &rows, &row_begin, &columns, &done));
  begin_.reserve(static_cast<std::size_t>(end_part_ - first_part_) + 1);
  for (int p = first_part_; p < end_part_; ++p) {
    const auto slots = numbering_.part_slots(p);
    begin_.push_back({runs_.size(), places_.size()});
    const auto equation = [&](int i) { return numbering_.equation(slots[static_cast<std::size_t>(i)]); };
    const int count = static_cast<int>(slots.size());
    for (int i = 0; i < count; ++i) {
      if (equation(i) < 0) continue;
      if (runs_.size() > begin_.back().run && i > 0 && equation(i - 1) >= 0 && equation(i) == equation(i - 1) + 1)
        ++runs_.back().length;
      else
        runs_.push_back({i, 1});
    }
    const std::size_t first = begin_.back().run, end = runs_.size();
    for (std::size_t r = first; r < end; ++r)
      for (int i = runs_[r].first; i < runs_[r].first + runs_[r].length; ++i) {
        const PetscInt row = equation(i);
        for (std::size_t c = first; c < end; ++c)
          places_.push_back(static_cast<PetscInt>(
              std::lower_bound(columns + row_begin[row], columns + row_begin[row + 1], equation(runs_[c].first)) - columns));
      }
  }
  begin_.push_back({runs_.size(), places_.size()});
  runs_.shrink_to_fit();
  places_.shrink_to_fit();
  check_petsc(MatRestoreRowIJ(matrix_, 0, PETSC_FALSE, PETSC_FALSE, &rows, &row_begin, &columns, &done));
}

Mat Scatter::new_matrix() const {
  Mat matrix = nullptr;
  check_petsc(MatDuplicate(matrix_, MAT_SHARE_NONZERO_PATTERN, &matrix));
  return matrix;
}

Vec Scatter::new_vector() const {
  Vec vector = nullptr;
  check_petsc(MatCreateVecs(matrix_, nullptr, &vector));
  return vector;
}

std::size_t Scatter::bytes() const {
  return begin_.size() * sizeof(Begin) + runs_.size() * sizeof(Run) + places_.size() * sizeof(PetscInt);
}

Scatter::MatrixSum::MatrixSum(const Scatter& scatter, Mat matrix) : scatter_(scatter), matrix_(matrix) {
  check_petsc(MatZeroEntries(matrix));
  if (scatter.size_ == 1) check_petsc(MatSeqAIJGetArray(matrix, &values_));
}

void Scatter::MatrixSum::add(int part, std::span<const double> k) {
  const Numbering& numbering = scatter_.numbering_;
  const auto slots = numbering.part_slots(part);
  const std::size_t n = slots.size();
  if (!values_) {
    // PETSc leaves out what has a negative number
    std::vector<PetscInt> equations(n);
    for (std::size_t i = 0; i < n; ++i) equations[i] = numbering.equation(slots[i]);
    const auto count = static_cast<PetscInt>(n);
    check_petsc(MatSetValues(matrix_, count, equations.data(), count, equations.data(), k.data(), ADD_VALUES));
    return;
  }
  const auto at = static_cast<std::size_t>(part - scatter_.first_part_);
  const Run *first = scatter_.runs_.data() + scatter_.begin_[at].run, *end = scatter_.runs_.data() + scatter_.begin_[at + 1].run;
  const PetscInt* place = scatter_.places_.data() + scatter_.begin_[at].place;
  for (const Run* rows = first; rows != end; ++rows)
    for (int i = rows->first; i < rows->first + rows->length; ++i) {
      const double* row = k.data() + static_cast<std::size_t>(i) * n;
      for (const Run* columns = first; columns != end; ++columns) {
        PetscScalar* to = values_ + *place++;
        const double* from = row + columns->first;
        for (int c = 0; c < columns->length; ++c) to[c] += from[c];
      }
    }
}

void Scatter::MatrixSum::leave_array() {
  if (values_) check_petsc(MatSeqAIJRestoreArray(matrix_, &values_));
  values_ = nullptr;
}

void Scatter::MatrixSum::add_diagonal(PetscInt row, double value) {
  leave_array();
  check_petsc(MatSetValue(matrix_, row, row, value, ADD_VALUES));
}

void Scatter::MatrixSum::finish() {
  leave_array();
  check_petsc(MatAssemblyBegin(matrix_, MAT_FINAL_ASSEMBLY));
  check_petsc(MatAssemblyEnd(matrix_, MAT_FINAL_ASSEMBLY));
}

Scatter::MatrixSum::~MatrixSum() {
  if (values_) (void)MatSeqAIJRestoreArray(matrix_, &values_);
}

Scatter::VectorSum::VectorSum(const Scatter& scatter, Vec vector) : vector_(vector) {
  check_petsc(VecSet(vector, 0));
  if (scatter.size_ == 1) check_petsc(VecGetArray(vector, &values_));
}

void Scatter::VectorSum::finish() {
  if (values_) {
    check_petsc(VecRestoreArray(vector_, &values_));
    return;
  }
  check_petsc(VecAssemblyBegin(vector_));
  check_petsc(VecAssemblyEnd(vector_));
}

Scatter::VectorSum::~VectorSum() {
  if (values_) (void)VecRestoreArray(vector_, &values_);
}

}  // namespace engrane
