// SPDX-License-Identifier: BSD-3-Clause
#include "solve/constraints/constraint_factors.hpp"

#include <cmath>

namespace engrane::solve {

using Sparse = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;

double size_of(const Unknown& u, double extent) {
  return u.measure == Measure::force || u.measure == Measure::length ? extent : 1.0;
}

const Unknown& multiplier_unknown(const Numbering& numbering, int multiplier) {
  return numbering.unknown(numbering.equation(numbering.motion_slots() + multiplier));
}

const Multiplier& multiplier_of(const Model& model, const Unknown& multiplier) {
  const Model::Part& part = model.parts[static_cast<std::size_t>(multiplier.part)];
  return part.element->layout().multipliers[static_cast<std::size_t>(multiplier.item)];
}

bool is_drive(const Model& model, const Unknown& multiplier) { return multiplier_of(model, multiplier).role == Role::drive; }

double relative_open(const Assembler& assembler, int multiplier, double phi) {
  return std::abs(phi) / size_of(multiplier_unknown(assembler.numbering(), multiplier), assembler.model().extent());
}

Configuration outside_of_steps(Configuration c) {
  for (NodeState& node : c.nodes) node.T.setIdentity();
  return c;
}

ConstraintMatrix::ConstraintMatrix(Assembler& assembler, const Configuration& configuration, ConstraintColumns kind) {
  const Numbering& numbering = assembler.numbering();
  const double extent = assembler.model().extent();
  std::vector<int> row_of(static_cast<std::size_t>(numbering.motion_slots()), -1);
  for (int e = 0; e < numbering.equations(); ++e) {
    const Unknown& u = numbering.unknown(e);
    if (u.multiplier) continue;
    row_of[static_cast<std::size_t>(u.slot)] = static_cast<int>(row_size.size());
    row_size.push_back(size_of(u, extent));
    slot.push_back(static_cast<std::size_t>(u.slot));
  }
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<double> r, k;
  const auto& parts = assembler.model().parts;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const std::size_t count = parts[p].element->layout().multipliers.size();
    if (count == 0) continue;
    const auto& slots = numbering.part_slots(static_cast<int>(p));
    const std::size_t n = slots.size(), first = n - count;
    r.assign(n, 0);
    k.assign(n * n, 0);
    parts[p].element->tangent(assembler.view(static_cast<int>(p), configuration), {1, 0, 0}, r, k);
    for (std::size_t m = first; m < n; ++m)
      for (std::size_t i = 0; i < first; ++i) {
        const int row = row_of[static_cast<std::size_t>(slots[i])];
        const double value = kind == ConstraintColumns::gradients ? -k[m * n + i] : k[i * n + m];
        if (row < 0 || value == 0) continue;
        entries.emplace_back(row, slots[m] - numbering.motion_slots(), value * row_size[static_cast<std::size_t>(row)]);
      }
  }
  matrix.resize(static_cast<Eigen::Index>(row_size.size()),
                static_cast<Eigen::Index>(numbering.slots() - numbering.motion_slots()));
  matrix.setFromTriplets(entries.begin(), entries.end());
}

void ConstraintMatrix::to_slots(const Vector& motion, std::vector<double>& y) const {
  for (std::size_t i = 0; i < slot.size(); ++i) y[slot[i]] = motion[static_cast<Eigen::Index>(i)] * row_size[i];
}

ConstraintFactors::ConstraintFactors(Assembler& assembler, const Configuration& configuration, ConstraintColumns kind,
                                     double tolerance)
    : gradients_(assembler, configuration, kind) {
  Sparse matrix = gradients_.matrix;
  length_ = Vector::Ones(matrix.cols());
  for (Eigen::Index m = 0; m < matrix.cols(); ++m) {
    const double length = matrix.col(m).norm();
    if (!(length > 0)) continue;
    length_[m] = length;
    matrix.col(m) /= length;
  }
  matrix.makeCompressed();
  if (matrix.rows() == 0 || matrix.cols() == 0 || matrix.nonZeros() == 0) return;
  qr_.setPivotThreshold(tolerance);
  qr_.compute(matrix);
  rank_ = qr_.rank();
}

Eigen::MatrixXd ConstraintFactors::null_multipliers(bool scaled_back) const {
  const Eigen::Index d = deficiency();
  Eigen::MatrixXd null = Eigen::MatrixXd::Zero(columns(), d);
  Eigen::MatrixXd weights(rank_, d);
  if (rank_ > 0) {
    const Sparse r = qr_.matrixR();
    weights = Eigen::MatrixXd(r.topRows(rank_).rightCols(d));
    const Sparse square = r.topLeftCorner(rank_, rank_);
    square.triangularView<Eigen::Upper>().solveInPlace(weights);
  }
  for (Eigen::Index j = 0; j < d; ++j) {
    for (Eigen::Index i = 0; i < rank_; ++i) null(pivot(i), j) = -weights(i, j);
    null(pivot(rank_ + j), j) = 1;
  }
  if (scaled_back) null.array().colwise() /= length_.array();
  return null;
}

Vector ConstraintFactors::possible_motion(const Vector& wish) const {
  if (rank_ == 0) return wish;
  Vector y = qr_.matrixQ().transpose() * wish;
  y.head(rank_).setZero();
  return qr_.matrixQ() * y;
}

Vector ConstraintFactors::closing_motion(const std::vector<double>& phi) const {
  Vector y = Vector::Zero(rows());
  if (rank_ == 0) return y;
  Vector right(rank_);
  for (Eigen::Index i = 0; i < rank_; ++i) right[i] = -phi[static_cast<std::size_t>(pivot(i))] / length_[pivot(i)];
  const Sparse square = Sparse(qr_.matrixR()).topLeftCorner(rank_, rank_);
  const Sparse lower = square.transpose();
  lower.triangularView<Eigen::Lower>().solveInPlace(right);
  y.head(rank_) = right;
  return qr_.matrixQ() * y;
}

}  // namespace engrane::solve
