// SPDX-License-Identifier: BSD-3-Clause
#include "solve/schemes/stage_matrices.hpp"

#include "solve/algebra/rows.hpp"

namespace engrane::solve {

StageMatrices new_stage_matrices(Assembler& assembler) {
  StageMatrices matrices;
  for (Owned<Mat>* matrix : {&matrices.stiffness, &matrices.damping, &matrices.mass}) *matrix->out() = assembler.new_matrix();
  return matrices;
}

void evaluate_at(Assembler& assembler, const Configuration& c, const StageMatrices& matrices) {
  assembler.tangent(c, {1, 0, 0}, matrices.stiffness);
  assembler.tangent(c, {0, 1, 0, 0}, matrices.damping);
  assembler.tangent(c, {0, 0, 1, 0}, matrices.mass);
}

std::vector<double> magnitudes_times(const StageMatrices& matrices, double v, double a, std::span<const double> x) {
  std::vector<double> sums = magnitudes_times(matrices.stiffness, x);
  const std::vector<double> of_rates = magnitudes_times(matrices.damping, x), inertia = magnitudes_times(matrices.mass, x);
  for (std::size_t row = 0; row < sums.size(); ++row) sums[row] += v * of_rates[row] + a * inertia[row];
  return sums;
}

RowOfStage::RowOfStage(const StageMatrices& matrices, PetscInt row)
    : matrices_{matrices.stiffness, matrices.damping, matrices.mass}, row_(row) {
  for (std::size_t k = 0; k < values_.size(); ++k)
    check_petsc(MatGetRow(matrices_[k], row, &count_, k == 0 ? &columns_ : nullptr, &values_[k]));
}

RowOfStage::~RowOfStage() {
  for (std::size_t k = 0; k < values_.size(); ++k)
    (void)MatRestoreRow(matrices_[k], row_, nullptr, k == 0 ? &columns_ : nullptr, &values_[k]);
}

}  // namespace engrane::solve
