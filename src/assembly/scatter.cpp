// SPDX-License-Identifier: BSD-3-Clause
#include "assembly/scatter.hpp"

#include <algorithm>

namespace engrane {

namespace {

Scatter::Pieces pieces_of(Mat matrix, bool parallel) {
  Scatter::Pieces pieces{matrix, nullptr, nullptr};
  if (parallel) check_petsc(MatMPIAIJGetSeqAIJ(matrix, &pieces.own, &pieces.others, &pieces.global));
  return pieces;
}

/// Finds positions of entries in a sequential matrix.
class Places {
 public:
  explicit Places(Mat matrix) : matrix_(matrix) {
    if (matrix_) check_petsc(MatGetRowIJ(matrix_, 0, PETSC_FALSE, PETSC_FALSE, &rows_, &begin_, &columns_, &done_));
  }
  ~Places() {
    if (matrix_) (void)MatRestoreRowIJ(matrix_, 0, PETSC_FALSE, PETSC_FALSE, &rows_, &begin_, &columns_, &done_);
  }
  Places(const Places&) = delete;
  Places& operator=(const Places&) = delete;

  PetscInt of(PetscInt row, PetscInt column) const {
    return static_cast<PetscInt>(std::lower_bound(columns_ + begin_[row], columns_ + begin_[row + 1], column) - columns_);
  }

 private:
  Mat matrix_;
  const PetscInt *begin_ = nullptr, *columns_ = nullptr;
  PetscInt rows_ = 0;
  PetscBool done_ = PETSC_FALSE;
};

}  // namespace

Scatter::Scatter(const Numbering& numbering, MPI_Comm comm, bool half) : numbering_(numbering), comm_(comm), half_(half) {
  MPI_Comm_size(comm, &size_);
  find_pattern();
  find_places();
}

void Scatter::find_pattern() {
  const int n = numbering_.equations();
  check_petsc(MatCreate(comm_, matrix_.out()));
  const PetscInt first_row = numbering_.first_row(), own_rows = numbering_.end_row() - first_row;
  check_petsc(MatSetSizes(matrix_, own_rows, own_rows, n, n));
  check_petsc(MatSetType(matrix_, half_ ? MATSEQSBAIJ : MATAIJ));
  if (!half_) check_petsc(MatSetFromOptions(matrix_));
  // the elements that contribute to each row
  const auto rows = static_cast<std::size_t>(own_rows);
  std::vector<std::size_t> begin(rows + 1, 0);
  const auto for_each_row = [&](auto&& use) {
    for (const int p : numbering_.evaluated())
      for (const int slot : numbering_.part_slots(p))
        if (const int row = numbering_.equation(slot); numbering_.is_own(row)) use(p, static_cast<std::size_t>(row - first_row));
  };
  for_each_row([&](int, std::size_t row) { ++begin[row + 1]; });
  for (std::size_t row = 0; row < rows; ++row) begin[row + 1] += begin[row];
  std::vector<int> parts(begin[rows]);
  std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
  for_each_row([&](int part, std::size_t row) { parts[next[row]++] = part; });

  std::vector<PetscInt> row_begin{0}, columns, seen(static_cast<std::size_t>(n), -1);
  row_begin.reserve(rows + 1);
  if (half_) {
    // upper bound, as if no two elements shared a pair of equations; memory that is never written is never allocated
    std::size_t most = rows;
    for (const int p : numbering_.evaluated())
      most += numbering_.part_slots(p).size() * (numbering_.part_slots(p).size() + 1) / 2;
    columns.reserve(most);
  }
  // rows of the same node have the same elements and therefore the same columns
  const auto as_before = [&](std::size_t row) {
    return row > 0 && begin[row] > begin[row - 1] &&
           std::equal(parts.begin() + static_cast<std::ptrdiff_t>(begin[row]),
                      parts.begin() + static_cast<std::ptrdiff_t>(begin[row + 1]),
                      parts.begin() + static_cast<std::ptrdiff_t>(begin[row - 1]),
                      parts.begin() + static_cast<std::ptrdiff_t>(begin[row]));
  };
  for (std::size_t row = 0; row < rows; ++row) {
    const PetscInt own = first_row + static_cast<PetscInt>(row);
    if (as_before(row)) {
      // the upper triangle loses the diagonal entry of the previous row
      const auto last = static_cast<std::size_t>(row_begin[row - 1]) + (half_ ? 1 : 0), count = columns.size() - last;
      columns.resize(columns.size() + count);
      std::copy_n(columns.begin() + static_cast<std::ptrdiff_t>(last), count, columns.end() - static_cast<std::ptrdiff_t>(count));
      row_begin.push_back(static_cast<PetscInt>(columns.size()));
      continue;
    }
    const auto first = static_cast<std::ptrdiff_t>(columns.size());
    const auto add = [&](PetscInt column) {
      if (column < (half_ ? own : 0) || seen[static_cast<std::size_t>(column)] == own) return;
      seen[static_cast<std::size_t>(column)] = own;
      columns.push_back(column);
    };
    add(own);
    for (std::size_t e = begin[row]; e < begin[row + 1]; ++e)
      for (const int slot : numbering_.part_slots(parts[e])) add(numbering_.equation(slot));
    std::sort(columns.begin() + first, columns.end());
    row_begin.push_back(static_cast<PetscInt>(columns.size()));
  }
  preallocate(row_begin, columns);
}

void Scatter::preallocate(const std::vector<PetscInt>& row_begin, std::vector<PetscInt>& columns) {
  if (size_ > 1) {
    check_petsc(MatMPIAIJSetPreallocationCSR(matrix_, row_begin.data(), columns.data(), nullptr));
  } else {
    // as above, but without searching for the position of each entry
    std::vector<PetscInt> widths(row_begin.size() - 1);
    for (std::size_t row = 0; row < widths.size(); ++row) widths[row] = row_begin[row + 1] - row_begin[row];
    if (half_) {
      check_petsc(MatSeqSBAIJSetPreallocation(matrix_, 1, 0, widths.data()));
      check_petsc(MatSeqSBAIJSetColumnIndices(matrix_, columns.data()));
      check_petsc(MatSetOption(matrix_, MAT_GETROW_UPPERTRIANGULAR, PETSC_TRUE));
    } else {
      check_petsc(MatSeqAIJSetPreallocation(matrix_, 0, widths.data()));
      check_petsc(MatSeqAIJSetColumnIndices(matrix_, columns.data()));
    }
    check_petsc(MatAssemblyBegin(matrix_, MAT_FINAL_ASSEMBLY));
    check_petsc(MatAssemblyEnd(matrix_, MAT_FINAL_ASSEMBLY));
    check_petsc(MatZeroEntries(matrix_));
  }
  check_petsc(MatSetOption(matrix_, MAT_NEW_NONZERO_LOCATION_ERR, PETSC_TRUE));
  check_petsc(MatSetOption(matrix_, MAT_NO_OFF_PROC_ENTRIES, PETSC_TRUE));
}

void Scatter::find_runs(int part) {
  const auto slots = numbering_.part_slots(part);
  begin_.push_back({runs_.size(), places_.size(), true});
  int before = -1;
  for (int i = 0; i < static_cast<int>(slots.size()); ++i) {
    const int equation = numbering_.equation(slots[static_cast<std::size_t>(i)]);
    if (equation >= 0 && !numbering_.is_own(equation)) begin_.back().whole = false;
    if (equation >= 0) {
      if (before >= 0 && equation == before + 1 && numbering_.is_own(equation) == numbering_.is_own(before))
        ++runs_.back().length;
      else
        runs_.push_back({i, 1});
    }
    before = equation;
  }
}

void Scatter::forget_places() {
  // clear() would keep the memory
  std::vector<Begin>().swap(begin_);
  std::vector<Run>().swap(runs_);
  std::vector<PetscInt>().swap(places_);
}

void Scatter::find_places() {
  const Pieces pieces = pieces_of(matrix_, size_ > 1);
  const Places own(pieces.own), others(pieces.others);
  PetscInt columns = 0;
  if (pieces.others) check_petsc(MatGetSize(pieces.others, nullptr, &columns));
  const PetscInt first_row = numbering_.first_row();
  const auto place_of = [&](PetscInt row, PetscInt column) {
    if (numbering_.is_own(column)) return own.of(row - first_row, column - first_row);
    const auto local = static_cast<PetscInt>(std::lower_bound(pieces.global, pieces.global + columns, column) - pieces.global);
    return -1 - others.of(row - first_row, local);
  };
  const std::vector<int>& parts = numbering_.evaluated();
  begin_.reserve(parts.size() + 1);
  for (const int part : parts) {
    find_runs(part);
    const auto slots = numbering_.part_slots(part);
    const auto equation = [&](int i) { return numbering_.equation(slots[static_cast<std::size_t>(i)]); };
    const std::size_t first = begin_.back().run, end = runs_.size();
    for (std::size_t r = first; r < end; ++r) {
      if (!numbering_.is_own(equation(runs_[r].first))) continue;
      for (int i = runs_[r].first; i < runs_[r].first + runs_[r].length; ++i)
        for (std::size_t c = first; c < end; ++c) {
          // upper triangle: only the diagonal and the runs after it
          if (half_ && equation(runs_[c].first) < equation(runs_[r].first)) continue;
          places_.push_back(place_of(equation(i), half_ && c == r ? equation(i) : equation(runs_[c].first)));
        }
    }
  }
  begin_.push_back({runs_.size(), places_.size(), true});
  runs_.shrink_to_fit();
  places_.shrink_to_fit();
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

Scatter::MatrixSum::MatrixSum(Scatter& scatter, Mat matrix)
    : scatter_(scatter), matrix_(matrix), pieces_(pieces_of(matrix, scatter.size_ > 1)) {
  if (scatter.begin_.empty()) scatter.find_places();
  check_petsc(MatZeroEntries(matrix));
  check_petsc(scatter.half_ ? MatSeqSBAIJGetArray(pieces_.own, &own_) : MatSeqAIJGetArray(pieces_.own, &own_));
  if (pieces_.others) check_petsc(MatSeqAIJGetArray(pieces_.others, &others_));
}

void Scatter::MatrixSum::add_half(std::size_t at, std::span<const double> k) {
  const Numbering& numbering = scatter_.numbering_;
  const auto slots = numbering.part_slots(numbering.evaluated()[at]);
  const std::size_t n = slots.size();
  const auto equation = [&](const Run* run) { return numbering.equation(slots[static_cast<std::size_t>(run->first)]); };
  const Run *first = scatter_.runs_.data() + scatter_.begin_[at].run, *end = scatter_.runs_.data() + scatter_.begin_[at + 1].run;
  const PetscInt* place = scatter_.places_.data() + scatter_.begin_[at].place;
  for (const Run* rows = first; rows != end; ++rows) {
    const int begin = equation(rows);
    for (int i = rows->first; i < rows->first + rows->length; ++i) {
      const double* row = k.data() + static_cast<std::size_t>(i) * n;
      for (const Run* columns = first; columns != end; ++columns) {
        if (equation(columns) < begin) continue;
        PetscScalar* to = own_ + *place++;
        const int from = columns == rows ? i : columns->first;
        for (int c = from; c < columns->first + columns->length; ++c) *to++ += row[c];
      }
    }
  }
}

void Scatter::MatrixSum::add(std::size_t at, std::span<const double> k) {
  if (scatter_.half_) return add_half(at, k);
  const Numbering& numbering = scatter_.numbering_;
  const auto slots = numbering.part_slots(numbering.evaluated()[at]);
  const std::size_t n = slots.size();
  const Begin& begin = scatter_.begin_[at];
  const Run *first = scatter_.runs_.data() + begin.run, *end = scatter_.runs_.data() + scatter_.begin_[at + 1].run;
  const PetscInt* place = scatter_.places_.data() + begin.place;
  for (const Run* rows = first; rows != end; ++rows) {
    if (!begin.whole && !numbering.is_own(numbering.equation(slots[static_cast<std::size_t>(rows->first)]))) continue;
    for (int i = rows->first; i < rows->first + rows->length; ++i) {
      const double* row = k.data() + static_cast<std::size_t>(i) * n;
      for (const Run* columns = first; columns != end; ++columns, ++place) {
        PetscScalar* to = *place >= 0 ? own_ + *place : others_ - 1 - *place;
        const double* from = row + columns->first;
        for (int c = 0; c < columns->length; ++c) to[c] += from[c];
      }
    }
  }
}

void Scatter::MatrixSum::leave_arrays() {
  if (left_) return;
  left_ = true;
  check_petsc(scatter_.half_ ? MatSeqSBAIJRestoreArray(pieces_.own, &own_) : MatSeqAIJRestoreArray(pieces_.own, &own_));
  if (pieces_.others) check_petsc(MatSeqAIJRestoreArray(pieces_.others, &others_));
}

void Scatter::MatrixSum::add_diagonal(PetscInt row, double value) {
  leave_arrays();
  check_petsc(MatSetValue(matrix_, row, row, value, ADD_VALUES));
}

void Scatter::MatrixSum::finish() {
  leave_arrays();
  check_petsc(MatAssemblyBegin(matrix_, MAT_FINAL_ASSEMBLY));
  check_petsc(MatAssemblyEnd(matrix_, MAT_FINAL_ASSEMBLY));
}

Scatter::MatrixSum::~MatrixSum() {
  if (left_) return;
  (void)(scatter_.half_ ? MatSeqSBAIJRestoreArray(pieces_.own, &own_) : MatSeqAIJRestoreArray(pieces_.own, &own_));
  if (pieces_.others) (void)MatSeqAIJRestoreArray(pieces_.others, &others_);
}

Scatter::VectorSum::VectorSum(const Scatter& scatter, Vec vector) : numbering_(scatter.numbering_), vector_(vector) {
  check_petsc(VecSet(vector, 0));
  check_petsc(VecGetArray(vector, &values_));
}

Scatter::VectorSum::~VectorSum() {
  // needed even if this rank has no rows, and thus no array: PETSc must invalidate the cached norm on every rank
  (void)VecRestoreArray(vector_, &values_);
}

}  // namespace engrane
