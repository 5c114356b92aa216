// SPDX-License-Identifier: BSD-3-Clause
// Orders of elimination, and forms of the factors, of matrices with dense rows: nodes that all follow one.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "base/snapshot.hpp"
#include "solve/algebra/backward_error.hpp"
#include "solve/algebra/mumps.hpp"
#include "solve/algebra/mumps_analysis.hpp"
#include "solve/algebra/symmetry.hpp"

namespace engrane::solve {
namespace {

/// Springs between the given pairs of nodes, and to the ground; each node is tied by a multiplier to the last two
/// unknowns, whose rows have the same columns.
void make_followers(Owned<Mat>& matrix, PetscInt nodes, const std::vector<std::pair<PetscInt, PetscInt>>& springs) {
  const PetscInt size = 2 * nodes + 2, leader = 2 * nodes;
  std::vector<PetscInt> counts(static_cast<std::size_t>(size), 12);
  counts[counts.size() - 2] = counts.back() = nodes + 2;
  check_petsc(MatCreateSeqAIJ(PETSC_COMM_SELF, size, size, 0, counts.data(), matrix.out()));
  const auto add = [&](PetscInt i, PetscInt j, double value) {
    check_petsc(MatSetValue(matrix, i, j, value, ADD_VALUES));
    if (i != j) check_petsc(MatSetValue(matrix, j, i, value, ADD_VALUES));
  };
  for (const auto& [a, b] : springs) {
    const double stiffness = 2 + std::sin(static_cast<double>(a));
    add(a, a, stiffness);
    add(b, b, stiffness);
    add(a, b, -stiffness);
  }
  for (PetscInt node = 0; node < nodes; ++node) {
    add(node, node, 1);
    add(node, nodes + node, 1);
    add(nodes + node, nodes + node, 0);
    if (const PetscInt other = node ^ 1; other < nodes) {  // stored zeros, as elements leave them
      add(node, nodes + other, 0);
      if (node < other) add(nodes + node, nodes + other, 0);
    }
    for (const int which : {0, 1})
      add(leader + which, nodes + node, 1 + 0.5 * std::cos((1.7 + which) * static_cast<double>(node)));
  }
  for (const int which : {0, 1}) add(leader + which, leader + which, 3);
  add(leader, leader + 1, 0.5);
  check_petsc(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY));
  check_petsc(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY));
}

void make_chain(Owned<Mat>& matrix, PetscInt nodes) {
  std::vector<std::pair<PetscInt, PetscInt>> springs;
  for (PetscInt node = 0; node < nodes; node += 2) {  // pairs, whose rows have the same columns
    springs.emplace_back(node, node + 1);
    if (node == 0) continue;
    for (const PetscInt here : {node, node + 1})
      for (const PetscInt before : {node - 2, node - 1}) springs.emplace_back(before, here);
  }
  make_followers(matrix, nodes, springs);
}

void make_lattice(Owned<Mat>& matrix, PetscInt side) {
  std::vector<std::pair<PetscInt, PetscInt>> springs;
  for (PetscInt node = 0; node < side * side * side; ++node) {
    if (node % side > 0) springs.emplace_back(node - 1, node);
    if (node / side % side > 0) springs.emplace_back(node - side, node);
    if (node / side / side > 0) springs.emplace_back(node - side * side, node);
  }
  make_followers(matrix, side * side * side, springs);
}

/// ICNTL(7) and ICNTL(12) after an analysis.
std::pair<PetscInt, PetscInt> ordering_of(Mat matrix) {
  Owned<Mat> factors;
  analyse_for_mumps(matrix, true, 50, factors, [](Mat) {});
  PetscInt ordering = 0, compressed = 0;
  check_petsc(MatMumpsGetIcntl(factors, 7, &ordering));
  check_petsc(MatMumpsGetIcntl(factors, 12, &compressed));
  return {ordering, compressed};
}

constexpr PetscInt automatic = 7, minimum_degree = 6;

TEST(DenseRows, AreOrderedByMinimumDegreeWhereFactorsAreSmall) {
  Owned<Mat> chain;
  make_chain(chain, 5000);
  const DenseRows dense = dense_rows(chain);
  EXPECT_EQ(dense.work, 2 * 5002. * 5002.);
  EXPECT_DOUBLE_EQ(dense.share, 5002. / 10002.);
  EXPECT_EQ(ordering_of(chain), (std::pair<PetscInt, PetscInt>{minimum_degree, 1}));
  PetscBool left = PETSC_FALSE;  // the next analysis of another matrix has its own
  check_petsc(PetscOptionsHasName(nullptr, nullptr, "-mat_mumps_icntl_7", &left));
  EXPECT_FALSE(left);
}

TEST(DenseRows, AreOrderedByDissectionWhereFactorsAreLarge) {
  Owned<Mat> lattice;
  make_lattice(lattice, 13);
  EXPECT_EQ(ordering_of(lattice), (std::pair<PetscInt, PetscInt>{automatic, 1}));
}

TEST(DenseRows, OfSmallSystemsDoNotMatter) {
  Owned<Mat> chain;
  make_chain(chain, 60);
  EXPECT_EQ(dense_rows(chain).work, 0);  // 62 of 122 columns: fewer than ten times the root
  EXPECT_EQ(ordering_of(chain), (std::pair<PetscInt, PetscInt>{automatic, 0}));
}

/// The sum of a row of so many entries has more rounding than that of a short one: it was taken for asymmetry.
TEST(DenseRows, LeaveAMatrixSymmetric) {
  Owned<Mat> chain;
  make_chain(chain, 100000);
  Owned<Vec> right, solution;
  check_petsc(MatCreateVecs(chain, solution.out(), right.out()));
  check_petsc(VecSet(right, 1));
  Mumps mumps(chain);
  ASSERT_TRUE(mumps.factor());
  Snapshot snapshot;
  mumps.save(snapshot);
  EXPECT_EQ(snapshot.number("solver/MUMPS form"), 2);  // symmetric, with pivots
  mumps.solve(right, solution);
  BackwardError error(chain, {});
  EXPECT_LT(error.of(right, solution), 1e-13);
  check_petsc(MatSetValue(chain, 200000, 150000, 1e-10, ADD_VALUES));
  check_petsc(MatAssemblyBegin(chain, MAT_FINAL_ASSEMBLY));
  check_petsc(MatAssemblyEnd(chain, MAT_FINAL_ASSEMBLY));
  EXPECT_FALSE(SymmetryTest(chain).symmetric());  // the short row shows it
}

}  // namespace
}  // namespace engrane::solve
