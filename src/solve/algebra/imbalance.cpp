// SPDX-License-Identifier: BSD-3-Clause
#include "solve/algebra/imbalance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace engrane::solve {

namespace {

/// A constraint counts as closed up to this fraction of its length.
constexpr double closed = 64 * std::numeric_limits<double>::epsilon();

}  // namespace

void Imbalance::join(const Imbalance& other) {
  if (other.worst >= 0 && other.largest() > largest()) worst = other.worst;
  for (const auto part :
       {&Imbalance::force, &Imbalance::moment, &Imbalance::length, &Imbalance::angle, &Imbalance::constraint_force})
    this->*part = std::max(this->*part, other.*part);
}

Imbalance imbalance(const Assembler& assembler, const References& references, Vec residual) {
  const Numbering& numbering = assembler.numbering();
  double worst[5] = {0, 0, 0, 0, 0};  // four measures, kΦ over force
  struct {
    double value;
    int row;
  } located{-1, -1};
  PetscInt first = 0, end = 0;
  check_petsc(VecGetOwnershipRange(residual, &first, &end));
  const PetscScalar* values = nullptr;
  check_petsc(VecGetArrayRead(residual, &values));
  for (PetscInt row = first; row < end; ++row) {
    const auto equation = static_cast<int>(row);
    const Unknown& u = numbering.unknown(equation);
    double value = std::abs(values[row - first]), reference = references.load(equation);
    if (u.multiplier) {
      // kΦ is the force (or moment) that the open constraint stands for
      const double as_force = value / reference;
      const auto m = static_cast<std::size_t>(u.slot - numbering.motion_slots());
      value /= assembler.scale()[m];
      reference = references.length(equation);
      if (value > (assembler.stated.has(m) ? assembler.stated.rounding[m] : reference * closed))
        worst[4] = std::max(worst[4], as_force);
    }
    double relative = value / reference;
    if (std::isnan(relative)) relative = std::numeric_limits<double>::infinity();
    double& largest = worst[static_cast<int>(u.measure)];
    largest = std::max(largest, relative);
    if (relative > located.value) located = {relative, equation};
  }
  check_petsc(VecRestoreArrayRead(residual, &values));
  int size = 1;
  MPI_Comm_size(assembler.comm(), &size);
  if (size > 1) {
    MPI_Allreduce(MPI_IN_PLACE, worst, 5, MPI_DOUBLE, MPI_MAX, assembler.comm());
    MPI_Allreduce(MPI_IN_PLACE, &located, 1, MPI_DOUBLE_INT, MPI_MAXLOC, assembler.comm());
  }
  return {worst[0], worst[1], worst[2], worst[3], worst[4], located.row};
}

std::vector<double> rounding_of_unknowns(const Assembler& assembler, const References& references, const Configuration& c) {
  std::vector<double> size(static_cast<std::size_t>(assembler.numbering().equations()));
  for (std::size_t e = 0; e < size.size(); ++e) {
    const Unknown& u = assembler.numbering().unknown(static_cast<int>(e));
    const double place = u.node < 0 || u.item > 2 ? 0 : c.nodes[static_cast<std::size_t>(u.node)].x[u.item];
    size[e] = last_places * std::max(references.length(static_cast<int>(e)), std::abs(place));
  }
  return size;
}

bool is_noise(Vec residual, const std::vector<double>& noise) {
  const PetscScalar* left = nullptr;
  check_petsc(VecGetArrayRead(residual, &left));
  int yes = 1;
  for (std::size_t row = 0; row < noise.size(); ++row)
    if (!(std::abs(left[row]) <= noise[row])) yes = 0;
  check_petsc(VecRestoreArrayRead(residual, &left));
  MPI_Comm comm = MPI_COMM_SELF;
  check_petsc(PetscObjectGetComm(reinterpret_cast<PetscObject>(residual), &comm));
  MPI_Allreduce(MPI_IN_PLACE, &yes, 1, MPI_INT, MPI_LAND, comm);
  return yes != 0;
}

}  // namespace engrane::solve
