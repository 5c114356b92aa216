// SPDX-License-Identifier: BSD-3-Clause
#include "solve/algebra/probe.hpp"

#include <cmath>
#include <limits>
#include <utility>

namespace engrane::solve {

namespace {

/// Σ k (g x)² over the constraints k Φ = 0 and the unknowns of a motion x one by one; g = ∂Φ/∂x.
double stiffness_of_constraints(Assembler& assembler, Mat matrix, Vec motion) {
  const Numbering& numbering = assembler.numbering();
  if (numbering.slots() == numbering.motion_slots()) return 0;
  const std::span<const double> x = assembler.gather(motion);
  double sum = 0;
  for (int row = numbering.first_row(); row < numbering.end_row(); ++row) {
    PetscInt count = 0;
    const PetscInt* columns = nullptr;
    const PetscScalar* values = nullptr;
    check_petsc(MatGetRow(matrix, row, &count, &columns, &values));
    for (PetscInt at = 0; at < count; ++at) {
      // of the entries k g of a gradient, its column has all; of half a matrix, its column and its row together
      int moved = row, constraint = columns[at];
      if (assembler.half() && numbering.unknown(row).multiplier) std::swap(moved, constraint);
      if (numbering.unknown(moved).multiplier || !numbering.unknown(constraint).multiplier) continue;
      const auto multiplier = static_cast<std::size_t>(numbering.unknown(constraint).slot - numbering.motion_slots());
      if (assembler.released(static_cast<int>(multiplier))) continue;
      const double steep = values[at] * x[static_cast<std::size_t>(moved)];
      sum += steep * steep / assembler.scale()[multiplier];
    }
    check_petsc(MatRestoreRow(matrix, row, &count, &columns, &values));
  }
  MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, assembler.comm());
  return sum;
}

}  // namespace

double probe_value(std::size_t place) {
  constexpr double golden = 0.61803398874989485;
  const double turns = golden * static_cast<double>(place + 1);
  return 0.5 + turns - std::floor(turns);
}

void fill_probe(Vec vector, int other) {
  const auto every = static_cast<std::size_t>(other) + 1;
  PetscInt first = 0, end = 0;
  PetscScalar* x = nullptr;
  check_petsc(VecGetOwnershipRange(vector, &first, &end));
  check_petsc(VecGetArrayWrite(vector, &x));
  for (PetscInt i = first; i < end; ++i) x[i - first] = probe_value(every * (static_cast<std::size_t>(i) + 1) - 1);
  check_petsc(VecRestoreArrayWrite(vector, &x));
}

void fill_loads(const Assembler& assembler, Vec loads) {
  fill_probe(loads);
  const double lever = assembler.model().extent();
  PetscInt first = 0, end = 0;
  PetscScalar* x = nullptr;
  check_petsc(VecGetOwnershipRange(loads, &first, &end));
  check_petsc(VecGetArray(loads, &x));
  for (PetscInt i = first; i < end; ++i)
    if (assembler.numbering().unknown(static_cast<int>(i)).rotational()) x[i - first] *= lever;
  check_petsc(VecRestoreArray(loads, &x));
}

bool answer_probe(const Assembler& assembler, LinearSolver& solver, Owned<Vec>& load, Owned<Vec>& motion) {
  for (Owned<Vec>* vector : {&load, &motion}) *vector->out() = assembler.new_vector();
  fill_loads(assembler, load);
  return solver.solve(load, motion);
}

double relative_stiffness(Assembler& assembler, Mat matrix, Vec motion, Vec load) {
  Owned<Vec> weighted;
  check_petsc(VecDuplicate(motion, weighted.out()));
  check_petsc(MatGetDiagonal(matrix, weighted));
  check_petsc(VecAbs(weighted));
  check_petsc(VecPointwiseMult(weighted, weighted, motion));
  PetscScalar energy = 0, size = 0;
  check_petsc(VecDot(motion, load, &energy));
  check_petsc(VecDot(motion, weighted, &size));
  size += stiffness_of_constraints(assembler, matrix, motion);
  return size > 0 ? std::abs(energy) / size : std::numeric_limits<double>::infinity();
}

}  // namespace engrane::solve
