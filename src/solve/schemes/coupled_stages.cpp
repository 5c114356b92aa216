// SPDX-License-Identifier: BSD-3-Clause
#include "solve/schemes/coupled_stages.hpp"

#include <algorithm>

#include "math/rotation.hpp"
#include "solve/algebra/rows.hpp"
#include "solve/schemes/interleaved.hpp"

namespace engrane::solve {

namespace {

constexpr int components = 6;  // of a node, the last three of its rotation
constexpr int turns = 3;

std::vector<Vec> all_of(const std::vector<Owned<Vec>>& vectors) { return {vectors.begin(), vectors.end()}; }

}  // namespace

CoupledStages::CoupledStages(Assembler& assembler, const Collocation& collocation, const std::string& package)
    : assembler_(assembler), collocation_(collocation), package_(package) {
  const auto stages = static_cast<std::size_t>(collocation.stages());
  for (std::size_t i = 0; i < stages; ++i) matrices_.push_back(new_stage_matrices(assembler));
  *whole_.out() = new_interleaved_matrix(assembler.matrix(), static_cast<int>(stages));
  check_petsc(MatCreateVecs(whole_, solution_.out(), right_.out()));
  for (const unsigned char kind : kinds_of_rows(assembler.numbering())) kinds_.insert(kinds_.end(), stages, kind);
}

void CoupledStages::begin() { solver_ = std::make_unique<LinearSolver>(whole_, package_, kinds_); }

std::vector<CoupledStages::Rates> CoupledStages::rates_of_rotations(const std::vector<std::vector<double>>& increments,
                                                                    double h) const {
  const Eigen::MatrixXd inverse = collocation_.inverse / h;
  const Eigen::Index stages = inverse.rows();
  const auto at = [stages](Eigen::Index i, Eigen::Index j) { return static_cast<std::size_t>(i * stages + j); };
  std::vector<Rates> all(assembler_.model().nodes.size());
  for (std::size_t n = 1; n < all.size(); ++n) {
    std::vector<Vec3> y;
    for (const auto& slots : increments) y.emplace_back(slots.data() + components * n + turns);
    Rates& rates = all[n];
    rates.velocity.assign(at(stages, 0), Mat3::Zero());
    rates.acceleration = rates.velocity;
    for (Eigen::Index i = 0; i < stages; ++i) {
      Vec3 rate = Vec3::Zero();
      const Vec3& here = y[static_cast<std::size_t>(i)];
      for (Eigen::Index j = 0; j < stages; ++j) rate += inverse(i, j) * y[static_cast<std::size_t>(j)];
      const Mat3 tangent = rotation_tangent(here);
      for (Eigen::Index j = 0; j < stages; ++j) rates.velocity[at(i, j)] = inverse(i, j) * tangent;
      for (int c = 0; c < turns; ++c) rates.velocity[at(i, i)].col(c) += rotation_tangent_rate(here, Vec3::Unit(c), rate);
    }
    for (Eigen::Index i = 0; i < stages; ++i)
      for (Eigen::Index j = 0; j < stages; ++j)
        for (Eigen::Index k = 0; k < stages; ++k) rates.acceleration[at(i, k)] += inverse(i, j) * rates.velocity[at(j, k)];
  }
  return all;
}

void CoupledStages::assemble(const std::vector<Configuration>& places, const std::vector<Rates>& rotations, double h) {
  const auto stages = static_cast<Eigen::Index>(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) evaluate_at(assembler_, places[i], matrices_[i]);

  const Eigen::MatrixXd first = collocation_.inverse / h, second = first * first;
  const Numbering& numbering = assembler_.numbering();
  // C ∂v_i/∂y_j + M ∂a_i/∂y_j of column k
  const auto part_of_rates = [&](const RowOfStage& from, std::size_t k, Eigen::Index i, Eigen::Index j) {
    const auto columns = from.columns();
    const Unknown& u = numbering.unknown(static_cast<int>(columns[k]));
    if (u.node < 0 || u.item < turns) return first(i, j) * from.damping(k) + second(i, j) * from.mass(k);
    const Rates& rates = rotations[static_cast<std::size_t>(u.node)];
    const auto block = static_cast<std::size_t>(i * stages + j);
    double sum = 0;
    for (int c = 0; c < turns; ++c) {  // about the material axes, as far as these have equations
      const int equation = numbering.equation(components * u.node + turns + c);
      const auto place = std::lower_bound(columns.begin(), columns.end(), static_cast<PetscInt>(equation));
      if (equation < 0 || place == columns.end() || *place != equation) continue;
      const auto axis = static_cast<std::size_t>(place - columns.begin());
      sum += from.damping(axis) * rates.velocity[block](c, u.item - turns) +
             from.mass(axis) * rates.acceleration[block](c, u.item - turns);
    }
    return sum;
  };

  InterleavedRows rows(whole_, static_cast<int>(stages));
  PetscInt begin = 0, end = 0;
  check_petsc(MatGetOwnershipRange(matrices_.front().stiffness, &begin, &end));
  std::vector<double> values;
  for (PetscInt row = begin; row < end; ++row) {
    const bool constraint = numbering.unknown(static_cast<int>(row)).multiplier;  // it depends on positions of one stage only
    for (Eigen::Index i = 0; i < stages; ++i) {
      const RowOfStage from(matrices_[static_cast<std::size_t>(i)], row);
      values.clear();
      for (std::size_t k = 0; k < from.columns().size(); ++k)
        for (Eigen::Index j = 0; j < stages; ++j)
          values.push_back((i == j ? from.stiffness(k) : 0) + (constraint ? 0 : part_of_rates(from, k, i, j)));
      rows.write(row, static_cast<int>(i), from.columns(), values);
    }
  }
  rows.finish();
}

bool CoupledStages::solve(const std::vector<Configuration>& places, const std::vector<std::vector<double>>& increments, double h,
                          const std::vector<Owned<Vec>>& residuals, const std::vector<Owned<Vec>>& changes) {
  assemble(places, rates_of_rotations(increments, h), h);
  interleave(all_of(residuals), right_);
  check_petsc(VecScale(right_, -1));
  if (!solver_->solve(right_, solution_)) return false;
  separate(solution_, all_of(changes));
  return true;
}

}  // namespace engrane::solve
