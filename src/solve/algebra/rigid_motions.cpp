// SPDX-License-Identifier: BSD-3-Clause
#include "solve/algebra/rigid_motions.hpp"

#include <array>
#include <vector>

namespace engrane::solve {

namespace {

constexpr std::size_t count = 6;

/// Components of the six rigid-body motions in an unknown of a node at `x`.
std::array<double, count> shares(const Unknown& u, const Vec3& x) {
  std::array<double, count> of{};
  if (u.node < 0) return of;
  const auto axis = static_cast<std::size_t>(u.item % 3);
  if (u.item > 2) {
    of[3 + axis] = 1;
    return of;
  }
  of[axis] = 1;
  for (std::size_t k = 0; k < 3; ++k) of[3 + k] = Vec3::Unit(static_cast<int>(k)).cross(x)[u.item];
  return of;
}

/// Number of consecutive equations of a node, if it is the same for every node of this rank; otherwise 1.
PetscInt block_size(const Numbering& numbering) {
  PetscInt size = 0, length = 0;
  for (int row = numbering.first_row(); row < numbering.end_row(); ++row) {
    const Unknown& u = numbering.unknown(row);
    if (u.node < 0) return 1;
    ++length;
    if (row + 1 < numbering.end_row() && numbering.unknown(row + 1).node == u.node) continue;
    if (size > 0 && size != length) return 1;
    size = length;
    length = 0;
  }
  return size;
}

}  // namespace

void note_rigid_motions(const Assembler& assembler, Mat matrix) {
  const Model& model = assembler.model();
  const Numbering& numbering = assembler.numbering();
  Vec3 centre = Vec3::Zero();
  for (const Model::Node& node : model.nodes) centre += node.x / static_cast<double>(model.nodes.size());
  const double length = model.extent();

  std::array<Owned<Vec>, count> motions;
  for (std::size_t k = 0; k < count; ++k) {
    check_petsc(MatCreateVecs(matrix, motions[k].out(), nullptr));
    PetscScalar* values = nullptr;
    check_petsc(VecGetArrayWrite(motions[k], &values));
    for (int row = numbering.first_row(); row < numbering.end_row(); ++row) {
      const Unknown& u = numbering.unknown(row);
      const Vec3 x = u.node < 0 ? Vec3::Zero() : Vec3((model.nodes[static_cast<std::size_t>(u.node)].x - centre) / length);
      *values++ = shares(u, x)[k];
    }
    values -= numbering.end_row() - numbering.first_row();
    check_petsc(VecRestoreArrayWrite(motions[k], &values));
  }
  // orthonormalised, without motions that the model does not have (out of a plane)
  std::vector<Vec> kept;
  for (const Owned<Vec>& motion : motions) {
    PetscReal before = 0, after = 0;
    check_petsc(VecNorm(motion, NORM_2, &before));
    for (const Vec earlier : kept) {
      PetscScalar part = 0;
      check_petsc(VecDot(motion, earlier, &part));
      check_petsc(VecAXPY(motion, -part, earlier));
    }
    check_petsc(VecNormalize(motion, &after));
    if (after > 1e-8 * before) kept.push_back(motion);
  }
  Owned<MatNullSpace> space;
  MPI_Comm comm = assembler.comm();
  check_petsc(MatNullSpaceCreate(comm, PETSC_FALSE, static_cast<PetscInt>(kept.size()), kept.data(), space.out()));
  check_petsc(MatSetNearNullSpace(matrix, space));
  PetscInt least[] = {block_size(numbering), 0};
  if (least[0] == 0) least[0] = 6;  // a rank without equations does not restrict the block size
  least[1] = -least[0];
  MPI_Allreduce(MPI_IN_PLACE, least, 2, MPIU_INT, MPI_MIN, comm);
  if (least[0] == -least[1] && least[0] < 6) check_petsc(MatSetBlockSize(matrix, least[0]));
}

}  // namespace engrane::solve
