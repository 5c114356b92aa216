// SPDX-License-Identifier: BSD-3-Clause
#include "solve/algebra/condition.hpp"

#include <algorithm>
#include <cmath>

namespace engrane::solve {

namespace {

/// Replaces each entry by `change` of the entry and its index.
template <class Change>
void for_each(Vec vector, const Change& change) {
  PetscInt first = 0, end = 0;
  PetscScalar* values = nullptr;
  check_petsc(VecGetOwnershipRange(vector, &first, &end));
  check_petsc(VecGetArray(vector, &values));
  for (PetscInt i = first; i < end; ++i) values[i - first] = change(values[i - first], i);
  check_petsc(VecRestoreArray(vector, &values));
}

double norm1(Vec vector) {
  PetscReal norm = 0;
  check_petsc(VecNorm(vector, NORM_1, &norm));
  return norm;
}

}  // namespace

double inverse_norm(Factors& factors, Mat matrix) {
  constexpr int most_rounds = 5;
  Owned<Vec> x, y, z;
  check_petsc(MatCreateVecs(matrix, x.out(), y.out()));
  check_petsc(VecDuplicate(x, z.out()));
  PetscInt size = 0;
  check_petsc(VecGetSize(x, &size));
  if (size == 0) return 0;
  const auto n = static_cast<double>(size);
  check_petsc(VecSet(x, 1 / n));
  factors.solve(x, y);
  double estimate = norm1(y);
  PetscInt last = -1;
  for (int round = 0; round < most_rounds; ++round) {
    // gradient of the norm: its largest entry gives the next unit vector
    for_each(y, [](double value, PetscInt) { return value < 0 ? -1.0 : 1.0; });
    factors.solve_transposed(y, z);
    for_each(z, [](double value, PetscInt) { return std::abs(value); });
    PetscInt largest = 0;
    PetscReal value = 0;
    check_petsc(VecMax(z, &largest, &value));
    if (largest == last) break;
    last = largest;
    for_each(x, [largest](double, PetscInt i) { return i == largest ? 1.0 : 0.0; });
    factors.solve(x, y);
    const double found = norm1(y);
    if (!(found > estimate)) break;
    estimate = found;
  }
  // alternating signs, growing: finds what hides from the rounds above
  for_each(x, [n](double, PetscInt i) {
    const double size_of = n > 1 ? 1 + static_cast<double>(i) / (n - 1) : 1;
    return i % 2 == 0 ? size_of : -size_of;
  });
  factors.solve(x, y);
  return std::max(estimate, 2 * norm1(y) / (3 * n));
}

}  // namespace engrane::solve
