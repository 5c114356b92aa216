// SPDX-License-Identifier: BSD-3-Clause
#include "solve/constraints/out_of_plane.hpp"

#include "solve/constraints/constraint_factors.hpp"

namespace engrane::solve {

namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;

}  // namespace

OutOfPlane::OutOfPlane(Assembler& assembler) : assembler_(assembler) {
  const Model& model = assembler.model();
  if (!model.plane.active() || !model.plane.carries) return;
  slots_ = slots_out_of_plane(model, model.plane);
  row_.assign(static_cast<std::size_t>(assembler.numbering().motion_slots()), -1);
  for (std::size_t i = 0; i < slots_.size(); ++i) row_[static_cast<std::size_t>(slots_[i])] = static_cast<int>(i);
  column_.assign(model.plane.out_of_plane.size(), -1);
  holds_.assign(model.parts.size(), false);
  for (std::size_t m = 0; m < column_.size(); ++m) {
    if (!model.plane.out_of_plane[m]) continue;
    // a grip that acts out of the plane holds nothing, since nothing slides there
    if (is_grip(model, assembler.numbering().multiplier(static_cast<int>(m)))) continue;
    column_[m] = static_cast<int>(multipliers_.size());
    multipliers_.push_back(static_cast<int>(m));
    holds_[static_cast<std::size_t>(assembler.numbering().multiplier(static_cast<int>(m)).part)] = true;
  }
  for (std::size_t p = 1; p < holds_.size(); ++p)
    if (model.parts[p].element->layout().shares_multipliers) holds_[p] = holds_[p - 1];
}

const Configuration& OutOfPlane::completed(const Configuration& c) {
  if (slots_.empty()) return c;
  completed_ = c;
  find(completed_);
  return completed_;
}

void OutOfPlane::find(Configuration& c) {
  const Numbering& numbering = assembler_.numbering();
  const auto& parts = assembler_.model().parts;
  const double extent = assembler_.model().extent();
  const Configuration here = at_start_of_step(c);
  // rows are moments: forces are multiplied by the extent
  const auto size = [&](int slot) { return slot % 6 < 3 ? extent : 1.0; };
  const auto weight = [&](int m) { return size_of(numbering.multiplier(m), extent); };
  Vector right = Vector::Zero(static_cast<Eigen::Index>(slots_.size()));
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const auto part = static_cast<int>(p);
    const auto slots = numbering.part_slots(part);
    const std::size_t n = slots.size(), first = n - parts[p].element->layout().multipliers.size();
    const auto [r, k] = holds_[p] ? assembler_.element_tangent(part, here, {0, 0, 0, 1})
                                  : Assembler::ElementTangent{assembler_.element_residual(part, here), {}};
    for (std::size_t i = 0; i < first; ++i) {
      const int row = row_[static_cast<std::size_t>(slots[i])];
      if (row < 0) continue;
      right[row] -= r[i] * size(slots[i]);
      for (std::size_t j = first; holds_[p] && j < n; ++j) {
        const int m = slots[j] - numbering.motion_slots(), column = column_[static_cast<std::size_t>(m)];
        if (column >= 0) entries.emplace_back(row, column, k[i * n + j] * size(slots[i]) / weight(m));
      }
    }
  }
  Sparse forces(right.size(), static_cast<Eigen::Index>(multipliers_.size()));
  forces.setFromTriplets(entries.begin(), entries.end());
  // minimum-norm solution of forces x = right (rows are independent: examine_plane): forcesᵀ (forces forcesᵀ)⁻¹ right, refined
  const Sparse square = forces * Sparse(forces.transpose());
  factors_.compute(square);
  Vector x = Vector::Zero(forces.cols());
  for (int refinement = 0; refinement < 3; ++refinement) x += forces.transpose() * factors_.solve(right - forces * x);
  for (std::size_t i = 0; i < multipliers_.size(); ++i)
    c.multipliers[static_cast<std::size_t>(multipliers_[i])] = x[static_cast<Eigen::Index>(i)] / weight(multipliers_[i]);
}

}  // namespace engrane::solve
