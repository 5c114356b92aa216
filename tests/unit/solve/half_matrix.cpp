// SPDX-License-Identifier: BSD-3-Clause
// A symmetric matrix of which half is kept, against the same one kept whole.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "solve/algebra/backward_error.hpp"
#include "solve/algebra/mumps.hpp"
#include "solve/algebra/rows.hpp"

namespace engrane::solve {
namespace {

constexpr PetscInt size = 12, reach = 3;

/// A band, positive definite; of a half what is left of the diagonal is not given.
void make(Owned<Mat>& matrix, bool half) {
  if (half)
    check_petsc(MatCreateSeqSBAIJ(PETSC_COMM_SELF, 1, size, size, reach + 1, nullptr, matrix.out()));
  else
    check_petsc(MatCreateSeqAIJ(PETSC_COMM_SELF, size, size, 2 * reach + 1, nullptr, matrix.out()));
  for (PetscInt i = 0; i < size; ++i)
    for (PetscInt j = half ? i : std::max<PetscInt>(0, i - reach); j < std::min(size, i + reach + 1); ++j)
      check_petsc(MatSetValue(matrix, i, j, i == j ? 5 + i : std::sin(1.3 * static_cast<double>(i + j)), INSERT_VALUES));
  check_petsc(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY));
  check_petsc(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY));
}

void fill(Vec vector, double phase) {
  for (PetscInt i = 0; i < size; ++i)
    check_petsc(VecSetValue(vector, i, std::cos(phase * static_cast<double>(i + 1)), INSERT_VALUES));
}

struct Pair {
  Pair() {
    make(whole, false);
    make(half, true);
    check_petsc(MatCreateVecs(whole, x.out(), b.out()));
    fill(x, 0.7);
    fill(b, 2.1);
  }
  Owned<Mat> whole, half;
  Owned<Vec> x, b;
};

TEST(HalfMatrix, HasTheRowsOfTheWhole) {
  const Pair pair;
  EXPECT_FALSE(is_half(pair.whole));
  EXPECT_TRUE(is_half(pair.half));
  EXPECT_TRUE(is_sequential(pair.half));
  std::vector<double> sizes(size);
  for (std::size_t i = 0; i < sizes.size(); ++i) sizes[i] = 1 + 0.1 * static_cast<double>(i);
  EXPECT_EQ(magnitudes_times(pair.half, sizes), magnitudes_times(pair.whole, sizes));
}

TEST(HalfMatrix, LeavesTheSameRemainder) {
  const Pair pair;
  BackwardError of_whole(pair.whole, {}), of_half(pair.half, {});
  EXPECT_EQ(of_half.of(pair.b, pair.x), of_whole.of(pair.b, pair.x));
  PetscBool same = PETSC_FALSE;
  check_petsc(VecEqual(of_half.residual(), of_whole.residual(), &same));
  EXPECT_TRUE(same);
}

TEST(HalfMatrix, IsSolvedAsTheWholeIs) {
  const Pair pair;
  Owned<Vec> y;
  check_petsc(VecDuplicate(pair.x, y.out()));
  Mumps whole(pair.whole), half(pair.half);
  ASSERT_TRUE(whole.factor());
  ASSERT_TRUE(half.factor());
  whole.solve(pair.b, pair.x);
  half.solve(pair.b, y);
  PetscBool same = PETSC_FALSE;
  check_petsc(VecEqual(pair.x, y, &same));
  EXPECT_TRUE(same);
  half.solve_transposed(pair.b, y);
  check_petsc(VecAXPY(y, -1, pair.x));
  PetscReal off = 0;
  check_petsc(VecNorm(y, NORM_INFINITY, &off));
  EXPECT_LT(off, 1e-15);
}

TEST(HalfMatrix, ThatIsNotDefiniteIsFactoredWithPivots) {
  const Pair pair;
  check_petsc(MatSetValue(pair.half, 4, 4, -6, INSERT_VALUES));
  check_petsc(MatAssemblyBegin(pair.half, MAT_FINAL_ASSEMBLY));
  check_petsc(MatAssemblyEnd(pair.half, MAT_FINAL_ASSEMBLY));
  Mumps half(pair.half);
  ASSERT_TRUE(half.factor());
  EXPECT_FALSE(half.improvable());  // as a symmetric matrix it cannot be better
  half.solve(pair.b, pair.x);
  BackwardError error(pair.half, {});
  EXPECT_LT(error.of(pair.b, pair.x), 1e-14);
}

}  // namespace
}  // namespace engrane::solve
