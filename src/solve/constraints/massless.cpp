// SPDX-License-Identifier: BSD-3-Clause
#include "solve/constraints/massless.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "solve/constraints/diagnosis.hpp"
#include "solve/constraints/leaves.hpp"

namespace engrane::solve {

namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;
using Triplets = std::vector<Eigen::Triplet<double>>;

/// For a matrix with columns of length 1: it does not see a motion along which all columns are shorter than this.
constexpr double unseen = 1e-11;

/// The block of a tangent for the motions, scaled like them on both sides.
Triplets motion_block(Assembler& assembler, const Configuration& c, const MotionRows& rows, Weights weights) {
  Triplets entries;
  const auto& parts = assembler.model().parts;
  weights.multipliers = 0;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const auto& slots = assembler.numbering().part_slots(static_cast<int>(p));
    const std::size_t n = slots.size(), motions = n - parts[p].element->layout().multipliers.size();
    const auto k = assembler.element_tangent(static_cast<int>(p), c, weights).k;
    for (std::size_t i = 0; i < motions; ++i)
      for (std::size_t j = 0; j < motions; ++j) {
        const int row = rows.row[static_cast<std::size_t>(slots[i])], column = rows.row[static_cast<std::size_t>(slots[j])];
        if (row < 0 || column < 0 || k[i * n + j] == 0) continue;
        entries.emplace_back(
            row, column, k[i * n + j] * rows.size[static_cast<std::size_t>(row)] * rows.size[static_cast<std::size_t>(column)]);
      }
  }
  return entries;
}

/// Matrices side by side, with columns of length 1.
class SideBySide {
 public:
  explicit SideBySide(Eigen::Index rows) : rows_(rows) {}

  /// Adds a block of as many columns as rows.
  void add(const Triplets& block, bool transposed = false) {
    for (const auto& entry : block)
      all_.emplace_back(transposed ? entry.col() : entry.row(),
                        static_cast<int>(columns_) + (transposed ? entry.row() : entry.col()), entry.value());
    columns_ += rows_;
  }
  void add(const Sparse& block) {
    for (Eigen::Index j = 0; j < block.cols(); ++j)
      for (Sparse::InnerIterator it(block, j); it; ++it)
        all_.emplace_back(static_cast<int>(it.row()), static_cast<int>(columns_ + j), it.value());
    columns_ += block.cols();
  }

  Sparse matrix() const {
    Sparse sum(rows_, columns_);
    sum.setFromTriplets(all_.begin(), all_.end());
    Vector factor(columns_);
    for (Eigen::Index j = 0; j < columns_; ++j) factor[j] = 1 / std::max(sum.col(j).norm(), 1e-300);
    return with_columns_scaled(std::move(sum), factor);
  }

 private:
  Eigen::Index rows_, columns_ = 0;
  Triplets all_;
};

/// Whether the block of M of each node and each scalar is positive definite: then there are no massless motions.
bool all_have_mass(const Triplets& mass, const MotionRows& rows) {
  const std::size_t groups = rows.first_rows.size();
  std::vector<std::size_t> group_of(rows.slot.size());
  std::vector<Eigen::MatrixXd> blocks;
  for (std::size_t g = 0; g < groups; ++g) {
    const int end = g + 1 < groups ? rows.first_rows[g + 1] : static_cast<int>(rows.slot.size());
    for (int i = rows.first_rows[g]; i < end; ++i) group_of[static_cast<std::size_t>(i)] = g;
    blocks.emplace_back(Eigen::MatrixXd::Zero(end - rows.first_rows[g], end - rows.first_rows[g]));
  }
  for (const auto& entry : mass) {
    const std::size_t g = group_of[static_cast<std::size_t>(entry.row())];
    if (group_of[static_cast<std::size_t>(entry.col())] == g)
      blocks[g](entry.row() - rows.first_rows[g], entry.col() - rows.first_rows[g]) += entry.value();
  }
  for (const Eigen::MatrixXd& block : blocks) {
    if (!(block.diagonal().array() > 0).all()) return false;
    const Vector size = block.diagonal().cwiseSqrt().cwiseInverse();
    const Eigen::LDLT<Eigen::MatrixXd> factors(size.asDiagonal() * block * size.asDiagonal());
    if (!(factors.vectorD().minCoeff() > unseen)) return false;
  }
  return true;
}

/// Name of the largest component of a motion outside `determined`.
std::string outside(const Assembler& assembler, const MotionRows& rows, const RowSpace& determined) {
  const Vector any = rows.any();
  return rows.largest_part(assembler.numbering(), any - determined.part(any));
}

}  // namespace

MasslessMotions::MasslessMotions(Assembler& assembler, const Configuration& configuration) : rows_(assembler) {
  const Configuration c = at_start_of_step(configuration);
  const Triplets mass = motion_block(assembler, c, rows_, {0, 0, 1});
  if (all_have_mass(mass, rows_)) return;
  const auto n = static_cast<Eigen::Index>(rows_.slot.size());
  SideBySide seen(n);
  seen.add(mass);
  seen.add(mass, true);  // not symmetric for a controller
  seen.add(ConstraintMatrix(assembler, c, ConstraintColumns::gradients).matrix);
  seen_ = seen.matrix();
  determined_.emplace(seen_.transpose(), unseen);
  count_ = static_cast<int>(n - determined_->rank());
  if (count_ > 0) example_ = outside(assembler, rows_, *determined_);
}

std::string MasslessMotions::explain_unheld(Assembler& assembler, const Configuration& configuration) const {
  if (!any()) return {};
  const Configuration c = at_start_of_step(configuration);
  SideBySide seen(seen_.rows());
  seen.add(seen_);
  seen.add(motion_block(assembler, c, rows_, {1, 0, 0}));
  seen.add(motion_block(assembler, c, rows_, {0, 1, 0}));
  const RowSpace held(seen.matrix().transpose(), unseen);
  const auto count = seen_.rows() - held.rank();
  if (count == 0) return {};
  return fmt::format(
      "{} has no inertia, and no joint, spring or damper holds it{}: give it a mass, or a moment of inertia about the axis it "
      "turns about (INERTIA), make it part of a body (RIGID), or hold it by a support, spring or damper{}",
      outside(assembler, rows_, held), count > 1 ? fmt::format(" (one of {} such motions)", count) : "",
      plane_advice(assembler.model()));
}

void MasslessMotions::remove(std::span<double> slots) const {
  if (!any()) return;
  Vector x(static_cast<Eigen::Index>(rows_.slot.size()));
  for (std::size_t i = 0; i < rows_.slot.size(); ++i) x[static_cast<Eigen::Index>(i)] = slots[rows_.slot[i]] / rows_.size[i];
  x = determined_->part(x);
  for (std::size_t i = 0; i < rows_.slot.size(); ++i) slots[rows_.slot[i]] = x[static_cast<Eigen::Index>(i)] * rows_.size[i];
}

void MasslessMotions::keep(std::span<double> slots) const {
  std::vector<double> others(slots.begin(), slots.end());
  remove(others);
  for (std::size_t i = 0; i < slots.size(); ++i) slots[i] -= others[i];
}

void MasslessMotions::remove_forces(std::span<double> slots) const {
  if (!any()) return;
  // scaled like motions: a force times the size of its motion
  std::vector<double> scaled(slots.begin(), slots.end());
  for (std::size_t i = 0; i < rows_.slot.size(); ++i) scaled[rows_.slot[i]] *= rows_.size[i] * rows_.size[i];
  remove(scaled);
  for (std::size_t i = 0; i < rows_.slot.size(); ++i)
    slots[rows_.slot[i]] = scaled[rows_.slot[i]] / (rows_.size[i] * rows_.size[i]);
}

}  // namespace engrane::solve
