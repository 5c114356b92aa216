// SPDX-License-Identifier: BSD-3-Clause
#include "solve/algebra/backward_error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "solve/algebra/rows.hpp"

namespace engrane::solve {

namespace {

/// Subtracts the products of a row with `x` from `remainder` and adds their magnitudes to `terms`.
void add_row(const Rows& rows, PetscInt row, const PetscScalar* x, double& remainder, double& terms) {
  for (PetscInt k = rows.begin()[row]; k < rows.begin()[row + 1]; ++k) {
    const double term = rows.value()[k] * x[rows.column()[k]];
    remainder -= term;
    terms += std::abs(term);
  }
}

/// Does that for all rows of a matrix whose upper half is stored. A row gets its products in the order of the columns.
void add_halves(const Rows& rows, const PetscScalar* x, PetscScalar* remainder, double* terms) {
  for (PetscInt row = 0; row < rows.size(); ++row) {
    PetscInt k = rows.begin()[row];
    const PetscInt end = rows.begin()[row + 1];
    add_row(rows, row, x, remainder[row], terms[row]);
    for (++k; k < end; ++k) {
      const PetscInt column = rows.column()[k];
      const double term = rows.value()[k] * x[row];
      remainder[column] -= term;
      terms[column] += std::abs(term);
    }
  }
}

/// Kind of rows without a mechanical unit, after those of Measure.
constexpr unsigned char signal_rows = 4;

}  // namespace

std::vector<unsigned char> kinds_of_rows(const Numbering& numbering) {
  std::vector<unsigned char> kinds;
  for (const Unknown& u : numbering.unknowns()) kinds.push_back(u.signal ? signal_rows : static_cast<unsigned char>(u.measure));
  return kinds;
}

BackwardError::BackwardError(Mat matrix, const std::vector<unsigned char>& kinds) : matrix_(matrix), comm_(comm_of(matrix)) {
  check_petsc(MatCreateVecs(matrix, nullptr, residual_.out()));
  PetscInt first = 0, end = 0;
  check_petsc(MatGetOwnershipRange(matrix, &first, &end));
  parallel_ = !is_sequential(matrix);
  terms_.resize(static_cast<std::size_t>(end - first));
  if (!kinds.empty()) kinds_.assign(kinds.begin() + first, kinds.begin() + end);
}

const PetscScalar* BackwardError::fetch(Vec solution) {
  if (!own_) {
    const PetscInt* columns = nullptr;
    own_ = matrix_;
    if (parallel_) {
      check_petsc(MatMPIAIJGetSeqAIJ(matrix_, &own_, &others_, &columns));
      PetscInt count = 0;
      check_petsc(MatGetSize(others_, nullptr, &count));
      Owned<IS> from;
      check_petsc(ISCreateGeneral(PETSC_COMM_SELF, count, columns, PETSC_COPY_VALUES, from.out()));
      check_petsc(VecCreateSeq(PETSC_COMM_SELF, count, ghosts_.out()));
      check_petsc(VecScatterCreate(solution, from, ghosts_, nullptr, gather_.out()));
    }
  }
  if (!parallel_) return nullptr;
  check_petsc(VecScatterBegin(gather_, solution, ghosts_, INSERT_VALUES, SCATTER_FORWARD));
  check_petsc(VecScatterEnd(gather_, solution, ghosts_, INSERT_VALUES, SCATTER_FORWARD));
  const PetscScalar* values = nullptr;
  check_petsc(VecGetArrayRead(ghosts_, &values));
  return values;
}

double BackwardError::of(Vec right, Vec solution) {
  const PetscScalar *elsewhere = fetch(solution), *b = nullptr, *x = nullptr;
  PetscScalar* r = nullptr;
  check_petsc(VecGetArrayRead(right, &b));
  check_petsc(VecGetArrayRead(solution, &x));
  check_petsc(VecGetArrayWrite(residual_, &r));
  {
    const Rows own(own_);
    for (PetscInt row = 0; row < own.size(); ++row) {
      terms_[static_cast<std::size_t>(row)] = std::abs(b[row]);
      r[row] = b[row];
    }
    if (own.half())
      add_halves(own, x, r, terms_.data());
    else
      for (PetscInt row = 0; row < own.size(); ++row) add_row(own, row, x, r[row], terms_[static_cast<std::size_t>(row)]);
  }
  if (parallel_) {
    const Rows others(others_);
    for (PetscInt row = 0; row < others.size(); ++row)
      add_row(others, row, elsewhere, r[row], terms_[static_cast<std::size_t>(row)]);
    check_petsc(VecRestoreArrayRead(ghosts_, &elsewhere));
  }
  const double worst = largest_of(r);
  check_petsc(VecRestoreArrayWrite(residual_, &r));
  check_petsc(VecRestoreArrayRead(solution, &x));
  check_petsc(VecRestoreArrayRead(right, &b));
  return worst;
}

double BackwardError::largest_of(const PetscScalar* remainder) const {
  double worst = 0;
  std::array<double, 8> largest{};  // terms of each kind
  const bool told = !kinds_.empty();
  for (std::size_t row = 0; row < terms_.size(); ++row) {
    if (!std::isfinite(terms_[row])) worst = std::numeric_limits<double>::infinity();
    if (told) largest[kinds_[row]] = std::max(largest[kinds_[row]], terms_[row]);
  }
  if (parallel_) MPI_Allreduce(MPI_IN_PLACE, largest.data(), static_cast<int>(largest.size()), MPI_DOUBLE, MPI_MAX, comm_);
  for (std::size_t row = 0; row < terms_.size(); ++row) {
    double terms = terms_[row];
    if (told && terms <= fair_solution * largest[kinds_[row]]) terms = largest[kinds_[row]];
    if (terms > 0) worst = std::max(worst, std::abs(remainder[row]) / terms);
  }
  if (parallel_) MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_DOUBLE, MPI_MAX, comm_);
  return worst;
}

}  // namespace engrane::solve
