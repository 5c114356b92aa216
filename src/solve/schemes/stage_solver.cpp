// SPDX-License-Identifier: BSD-3-Clause
#include "solve/schemes/stage_solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "solve/algebra/rows.hpp"
#include "solve/schemes/interleaved.hpp"
#include "solve/schemes/snapshot_part.hpp"

namespace engrane::solve {

namespace {

/// `sum` = Σ factors(j) vectors[j].
void add_up(const Eigen::VectorXd& factors, const std::vector<Owned<Vec>>& vectors, Vec sum) {
  check_petsc(VecSet(sum, 0));
  for (Eigen::Index j = 0; j < factors.size(); ++j) check_petsc(VecAXPY(sum, factors[j], vectors[static_cast<std::size_t>(j)]));
}

Weights weights_of(const Collocation::Block& b, double h) {
  return {1, b.alpha / h, (b.alpha * b.alpha - b.beta * b.beta) / (h * h)};
}

Weights imaginary_weights_of(const Collocation::Block& b, double h) { return {0, b.beta / h, 2 * b.alpha * b.beta / (h * h), 0}; }

}  // namespace

StageSolver::StageSolver(Assembler& assembler, const Collocation& collocation, const std::string& package)
    : assembler_(assembler), collocation_(collocation) {
  const std::vector<unsigned char> kinds = kinds_of_rows(assembler.numbering());
  std::vector<unsigned char> kinds_of_pairs;
  for (const unsigned char kind : kinds) kinds_of_pairs.insert(kinds_of_pairs.end(), 2, kind);
  for (const Collocation::Block& block : collocation.blocks) {
    System& system = systems_.emplace_back();
    system.block = block;
    if (block.complex()) {
      *system.whole.out() = new_interleaved_matrix(assembler.matrix(), 2);
      check_petsc(MatCreateVecs(system.whole, system.solution.out(), system.right.out()));
    } else {
      *system.whole.out() = assembler.new_matrix();
    }
    system.solver = std::make_unique<LinearSolver>(system.whole, package, block.complex() ? kinds_of_pairs : kinds);
  }
  for (Eigen::Index i = 0; i < collocation.stages(); ++i) {
    *transformed_.emplace_back().out() = assembler.new_vector();
    *solved_.emplace_back().out() = assembler.new_vector();
  }
}

Weights StageSolver::weights(double h) const { return weights_of(systems_.front().block, h); }

void StageSolver::combine_pair(const StageMatrices& matrices, double h, const System& system) const {
  const Numbering& numbering = assembler_.numbering();
  const Weights real = weights_of(system.block, h), imaginary = imaginary_weights_of(system.block, h);
  PetscInt first = 0, end = 0;
  check_petsc(MatGetOwnershipRange(matrices.stiffness, &first, &end));
  InterleavedRows rows(system.whole, 2);
  std::vector<double> pair[2];
  for (PetscInt row = first; row < end; ++row) {
    const RowOfStage from(matrices, row);
    const auto columns = from.columns();
    // constraint rows have no imaginary part; the row of a released constraint is only the 1 of its equation
    const double part = numbering.unknown(static_cast<int>(row)).multiplier ? 0 : 1;
    for (auto& values_of_row : pair) values_of_row.resize(2 * columns.size());
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const double c = from.damping(i), m = from.mass(i);
      const double re = from.stiffness(i) + real.v * c + real.a * m, im = part * (imaginary.v * c + imaginary.a * m);
      pair[0][2 * i] = pair[1][2 * i + 1] = re;
      pair[0][2 * i + 1] = -im;
      pair[1][2 * i] = im;
    }
    for (int of_row = 0; of_row < 2; ++of_row) rows.write(row, of_row, columns, pair[of_row]);
  }
  rows.finish();
}

void StageSolver::combine(const StageMatrices& matrices, double h) {
  for (System& system : systems_) {
    if (system.block.complex()) {
      combine_pair(matrices, h, system);
      continue;
    }
    const Weights weights = weights_of(system.block, h);
    check_petsc(MatCopy(matrices.stiffness, system.whole, SAME_NONZERO_PATTERN));
    check_petsc(MatAXPY(system.whole, weights.v, matrices.damping, SAME_NONZERO_PATTERN));
    check_petsc(MatAXPY(system.whole, weights.a, matrices.mass, SAME_NONZERO_PATTERN));
  }
}

bool StageSolver::solve(const std::vector<Owned<Vec>>& residuals, const std::vector<Owned<Vec>>& changes) {
  for (std::size_t i = 0; i < residuals.size(); ++i)
    add_up(-collocation_.untransform.row(static_cast<Eigen::Index>(i)).transpose(), residuals, transformed_[i]);
  for (System& system : systems_) {
    const auto k = static_cast<std::size_t>(system.block.first);
    if (!system.block.complex()) {
      if (!system.solver->solve(transformed_[k], solved_[k])) return false;
      continue;
    }
    interleave(std::array<Vec, 2>{transformed_[k], transformed_[k + 1]}, system.right);
    if (!system.solver->solve(system.right, system.solution)) return false;
    separate(system.solution, std::array<Vec, 2>{solved_[k], solved_[k + 1]});
  }
  for (std::size_t i = 0; i < changes.size(); ++i)
    add_up(collocation_.transform.row(static_cast<Eigen::Index>(i)).transpose(), solved_, changes[i]);
  return true;
}

double StageSolver::real_rate() const { return real().block.alpha; }

const StageSolver::System& StageSolver::real() const {
  return *std::find_if(systems_.begin(), systems_.end(), [](const System& s) { return !s.block.complex(); });
}

bool StageSolver::solve_real(Vec residual, Vec change) {
  check_petsc(VecScale(residual, -1));
  return real().solver->solve(residual, change);
}

void StageSolver::save(Snapshot& snapshot) const {
  for (std::size_t i = 0; i < systems_.size(); ++i) save_part(*systems_[i].solver, fmt::format("stages/{}/", i), snapshot);
}

void StageSolver::restore_factors() {
  for (System& system : systems_) system.solver->restore_factors();
}

void StageSolver::load(const Snapshot& snapshot) {
  for (std::size_t i = 0; i < systems_.size(); ++i) systems_[i].solver->load(part_of(snapshot, fmt::format("stages/{}/", i)));
}

}  // namespace engrane::solve
