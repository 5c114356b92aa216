// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <vector>

#include "assembly/assembler.hpp"

namespace engrane::solve {

/// K, C and M at one configuration, scaled as the assembler was then (Assembler).
struct StageMatrices {
  Owned<Mat> stiffness, damping, mass;
};

StageMatrices new_stage_matrices(Assembler& assembler);
/// Evaluates them at `c`.
void evaluate_at(Assembler& assembler, const Configuration& c, const StageMatrices& matrices);

/// (|K| + v |C| + a |M|) x for this rank's rows: forces of unknowns that are off by x, where rates v and accelerations a times
/// as large are computed from them.
std::vector<double> magnitudes_times(const StageMatrices& matrices, double v, double a, std::span<const double> x);

/// One row of all three, for the lifetime of this object.
class RowOfStage {
 public:
  RowOfStage(const StageMatrices& matrices, PetscInt row);
  ~RowOfStage();
  RowOfStage(const RowOfStage&) = delete;
  RowOfStage& operator=(const RowOfStage&) = delete;

  std::span<const PetscInt> columns() const { return {columns_, static_cast<std::size_t>(count_)}; }
  /// Entries in columns()[k].
  double stiffness(std::size_t k) const { return values_[0][k]; }
  double damping(std::size_t k) const { return values_[1][k]; }
  double mass(std::size_t k) const { return values_[2][k]; }

 private:
  std::array<Mat, 3> matrices_;
  PetscInt row_, count_ = 0;
  const PetscInt* columns_ = nullptr;
  std::array<const PetscScalar*, 3> values_{};
};

}  // namespace engrane::solve
