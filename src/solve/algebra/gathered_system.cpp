// SPDX-License-Identifier: BSD-3-Clause
#include "solve/algebra/gathered_system.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "solve/algebra/rows.hpp"

namespace engrane::solve {

namespace {

/// The two sequential matrices that hold one rank's rows: the columns of its own rows, and the others.
struct Pieces {
  explicit Pieces(Mat shared) { check_petsc(MatMPIAIJGetSeqAIJ(shared, &own, &others, &global)); }

  Mat own = nullptr, others = nullptr;
  const PetscInt* global = nullptr;  ///< column of the shared matrix for each column of `others`
};

/// Start of each of several consecutive pieces.
std::vector<int> starts(const std::vector<int>& sizes) {
  std::vector<int> first(sizes.size());
  std::exclusive_scan(sizes.begin(), sizes.end(), first.begin(), 0);
  return first;
}

}  // namespace

GatheredSystem::GatheredSystem(Mat shared) : shared_(shared), comm_(comm_of(shared)) {
  MPI_Comm_rank(comm_, &rank_);
  PetscInt first = 0, end = 0;
  check_petsc(MatGetOwnershipRange(shared, &first, &end));
  std::vector<PetscInt> rows, columns;
  const Pieces pieces(shared);
  const auto note = [&](Mat piece, auto&& column) {
    const Rows of(piece);
    for (PetscInt row = 0; row < of.size(); ++row)
      for (PetscInt k = of.begin()[row]; k < of.begin()[row + 1]; ++k) {
        rows.push_back(first + row);
        columns.push_back(column(of.column()[k]));
      }
  };
  note(pieces.own, [&](PetscInt column) { return first + column; });
  note(pieces.others, [&](PetscInt column) { return pieces.global[column]; });
  own_.resize(rows.size());
  gather_sizes(end - first, rows.size());

  const auto gather = [&](const std::vector<PetscInt>& from) {
    std::vector<PetscInt> all(arrived_.size());
    MPI_Gatherv(from.data(), static_cast<int>(from.size()), MPIU_INT, all.data(), entries_of_.data(), first_entry_of_.data(),
                MPIU_INT, 0, comm_);
    return all;
  };
  const std::vector<PetscInt> all_rows = gather(rows), all_columns = gather(columns);
  if (here()) make_matrix(all_rows, all_columns);
}

void GatheredSystem::gather_sizes(PetscInt rows, std::size_t entries) {
  int ranks = 1;
  MPI_Comm_size(comm_, &ranks);
  const int own[] = {static_cast<int>(rows), static_cast<int>(entries)};
  std::vector<std::array<int, 2>> all(here() ? static_cast<std::size_t>(ranks) : 0);
  MPI_Gather(own, 2, MPI_INT, all.data(), 2, MPI_INT, 0, comm_);
  for (const auto& [rows_there, entries_there] : all) {
    rows_of_.push_back(rows_there);
    entries_of_.push_back(entries_there);
  }
  first_row_of_ = starts(rows_of_);
  first_entry_of_ = starts(entries_of_);
  arrived_.resize(static_cast<std::size_t>(std::accumulate(entries_of_.begin(), entries_of_.end(), 0)));
}

void GatheredSystem::make_matrix(const std::vector<PetscInt>& rows, const std::vector<PetscInt>& columns) {
  std::vector<std::size_t> order(rows.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return std::pair(rows[a], columns[a]) < std::pair(rows[b], columns[b]); });
  const PetscInt size = std::accumulate(rows_of_.begin(), rows_of_.end(), 0);
  std::vector<PetscInt> begin(static_cast<std::size_t>(size) + 1, 0), sorted(columns.size());
  place_.resize(columns.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    sorted[k] = columns[order[k]];
    place_[order[k]] = static_cast<PetscInt>(k);
    ++begin[static_cast<std::size_t>(rows[order[k]]) + 1];
  }
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  check_petsc(MatCreate(PETSC_COMM_SELF, matrix_.out()));
  check_petsc(MatSetSizes(matrix_, size, size, size, size));
  check_petsc(MatSetType(matrix_, MATSEQAIJ));
  check_petsc(MatSeqAIJSetPreallocationCSR(matrix_, begin.data(), sorted.data(), nullptr));
  check_petsc(MatCreateVecs(matrix_, solution_.out(), right_.out()));
}

void GatheredSystem::fetch_matrix() {
  const Pieces pieces(shared_);
  {
    const Rows own(pieces.own), others(pieces.others);
    const auto next = std::copy_n(own.value(), own.entries(), own_.begin());
    std::copy_n(others.value(), others.entries(), next);
  }
  MPI_Gatherv(own_.data(), static_cast<int>(own_.size()), MPI_DOUBLE, arrived_.data(), entries_of_.data(), first_entry_of_.data(),
              MPI_DOUBLE, 0, comm_);
  if (!here()) return;
  PetscScalar* values = nullptr;
  check_petsc(MatSeqAIJGetArrayWrite(matrix_, &values));
  for (std::size_t k = 0; k < place_.size(); ++k) values[place_[k]] = arrived_[k];
  check_petsc(MatSeqAIJRestoreArrayWrite(matrix_, &values));
}

void GatheredSystem::fetch(Vec right) {
  PetscInt size = 0;
  const PetscScalar* from = nullptr;
  PetscScalar* to = nullptr;
  check_petsc(VecGetLocalSize(right, &size));
  check_petsc(VecGetArrayRead(right, &from));
  if (here()) check_petsc(VecGetArrayWrite(right_, &to));
  MPI_Gatherv(from, size, MPI_DOUBLE, to, rows_of_.data(), first_row_of_.data(), MPI_DOUBLE, 0, comm_);
  if (here()) check_petsc(VecRestoreArrayWrite(right_, &to));
  check_petsc(VecRestoreArrayRead(right, &from));
}

void GatheredSystem::give(Vec solution) const {
  PetscInt size = 0;
  const PetscScalar* from = nullptr;
  PetscScalar* to = nullptr;
  check_petsc(VecGetLocalSize(solution, &size));
  check_petsc(VecGetArrayWrite(solution, &to));
  if (here()) check_petsc(VecGetArrayRead(solution_, &from));
  MPI_Scatterv(from, rows_of_.data(), first_row_of_.data(), MPI_DOUBLE, to, size, MPI_DOUBLE, 0, comm_);
  if (here()) check_petsc(VecRestoreArrayRead(solution_, &from));
  check_petsc(VecRestoreArrayWrite(solution, &to));
}

}  // namespace engrane::solve
