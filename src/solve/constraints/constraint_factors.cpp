// SPDX-License-Identifier: BSD-3-Clause
#include "solve/constraints/constraint_factors.hpp"

#include <cmath>

namespace engrane::solve {

using Sparse = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;

double size_of(const Unknown& u, double extent) {
  return u.measure == Measure::force || u.measure == Measure::length ? extent : 1.0;
}

const Multiplier& multiplier_of(const Model& model, const Unknown& multiplier) {
  const Model::Part& part = model.parts[static_cast<std::size_t>(multiplier.part)];
  return part.element->layout().multipliers[static_cast<std::size_t>(multiplier.item)];
}

bool is_drive(const Model& model, const Unknown& multiplier) { return multiplier_of(model, multiplier).role == Role::drive; }
bool is_grip(const Model& model, const Unknown& multiplier) { return multiplier_of(model, multiplier).role == Role::grip; }

Vector constraint_sizes(const Assembler& assembler) {
  const double extent = assembler.model().extent();
  const Numbering& numbering = assembler.numbering();
  Vector sizes(numbering.slots() - numbering.motion_slots());
  for (int m = 0; m < static_cast<int>(sizes.size()); ++m) sizes[m] = size_of(numbering.multiplier(m), extent);
  return sizes;
}

Vector relative_open(const Assembler& assembler, const std::vector<double>& phi) {
  return Eigen::Map<const Vector>(phi.data(), static_cast<Eigen::Index>(phi.size()))
      .cwiseAbs()
      .cwiseQuotient(constraint_sizes(assembler));
}

MotionRows::MotionRows(const Assembler& assembler) {
  const Numbering& numbering = assembler.numbering();
  const double extent = assembler.model().extent();
  row.assign(static_cast<std::size_t>(numbering.motion_slots()), -1);
  int node = -1;
  for (int e = 0; e < numbering.equations(); ++e) {
    const Unknown& u = numbering.unknown(e);
    if (u.multiplier) continue;
    const auto next = static_cast<int>(slot.size());
    row[static_cast<std::size_t>(u.slot)] = next;
    if (next == 0 || u.node < 0 || u.node != node) first_rows.push_back(next);
    node = u.node;
    size.push_back(size_of(u, extent));
    slot.push_back(static_cast<std::size_t>(u.slot));
  }
}

Vector MotionRows::any() const {
  Vector motion(static_cast<Eigen::Index>(slot.size()));
  for (Eigen::Index i = 0; i < motion.size(); ++i) motion[i] = 1 + 0.5 * std::sin(2.3 * static_cast<double>(i + 1));
  return motion;
}

std::string MotionRows::largest_part(const Numbering& numbering, const Vector& motion) const {
  const auto equation = [&](Eigen::Index at) { return numbering.equation(static_cast<int>(slot[static_cast<std::size_t>(at)])); };
  Eigen::Index most = 0, node = -1;
  const double enough = 0.1 * motion.cwiseAbs().maxCoeff(&most);
  for (Eigen::Index i = 0; i < motion.size(); ++i)
    if (numbering.unknown(equation(i)).part < 0 && std::abs(motion[i]) > enough &&
        (node < 0 || std::abs(motion[i]) > std::abs(motion[node])))
      node = i;
  return numbering.describe(equation(node >= 0 ? node : most));
}

ConstraintMatrix::ConstraintMatrix(Assembler& assembler, const Configuration& configuration, ConstraintColumns kind)
    : rows(assembler) {
  const Numbering& numbering = assembler.numbering();
  std::vector<Eigen::Triplet<double>> entries;
  const auto& parts = assembler.model().parts;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const std::size_t count = parts[p].element->layout().multipliers.size();
    if (count == 0) continue;
    const auto& slots = numbering.part_slots(static_cast<int>(p));
    const std::size_t n = slots.size(), first = n - count;
    const auto k = assembler.element_tangent(static_cast<int>(p), configuration, {1, 0, 0}).k;
    for (std::size_t m = first; m < n; ++m) {
      if (assembler.idle(slots[m] - numbering.motion_slots())) continue;
      for (std::size_t i = 0; i < first; ++i) {
        const int row = rows.row[static_cast<std::size_t>(slots[i])];
        const double value = kind == ConstraintColumns::gradients ? -k[m * n + i] : k[i * n + m];
        if (row < 0 || value == 0) continue;
        entries.emplace_back(row, slots[m] - numbering.motion_slots(), value * rows.size[static_cast<std::size_t>(row)]);
      }
    }
  }
  matrix.resize(static_cast<Eigen::Index>(rows.slot.size()),
                static_cast<Eigen::Index>(numbering.slots() - numbering.motion_slots()));
  matrix.setFromTriplets(entries.begin(), entries.end());
}

void ConstraintMatrix::to_slots(const Vector& motion, std::vector<double>& y) const {
  for (std::size_t i = 0; i < rows.slot.size(); ++i) y[rows.slot[i]] = motion[static_cast<Eigen::Index>(i)] * rows.size[i];
}

namespace {

Vector lengths(const Sparse& matrix) {
  Vector length(matrix.cols());
  for (Eigen::Index m = 0; m < matrix.cols(); ++m) length[m] = matrix.col(m).norm();
  return (length.array() > 0).select(length, 1.0);
}

}  // namespace

ConstraintFactors::ConstraintFactors(Assembler& assembler, const Configuration& configuration, ConstraintColumns kind,
                                     double tolerance)
    : gradients_(assembler, configuration, kind),
      length_(lengths(gradients_.matrix)),
      basis_(with_columns_scaled(gradients_.matrix, length_.cwiseInverse()), tolerance, gradients_.rows.first_rows),
      any_idle_(assembler.idle_count() > 0) {
  if (!any_idle_) return;
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t j = 0; j < basis_.dependent().size(); ++j) {
    if (assembler.idle(basis_.dependent()[j])) continue;
    for (Sparse::InnerIterator it(basis_.null(), static_cast<Eigen::Index>(j)); it; ++it)
      entries.emplace_back(static_cast<int>(it.row()), static_cast<int>(dependent_.size()), it.value());
    dependent_.push_back(basis_.dependent()[j]);
  }
  null_.resize(basis_.null().rows(), static_cast<Eigen::Index>(dependent_.size()));
  null_.setFromTriplets(entries.begin(), entries.end());
}

Vector ConstraintFactors::closing_motion(const std::vector<double>& phi) const {
  Vector right(columns());
  for (Eigen::Index m = 0; m < columns(); ++m) right[m] = -phi[static_cast<std::size_t>(m)] / length_[m];
  return basis_.solve_transposed(right);
}

}  // namespace engrane::solve
