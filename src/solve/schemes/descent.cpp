// SPDX-License-Identifier: BSD-3-Clause
#include "solve/schemes/descent.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace engrane::solve {

namespace {

/// Part of its length by which the largest force would move its unknown in the first step against the viscosity alone.
constexpr double first_part = 0.03;
/// Part of its length by which an unknown may move in a step.
constexpr double largest_move = 0.2;
/// The viscosity becomes less after each step by the one factor, and more after each that was too long by the other.
constexpr double thinner = 1.0 / 3, thicker = 4;
constexpr int most_tries = 200, most_in_vain = 30;
/// A step takes at most so many corrections, until the last is this part of its way.
constexpr int most_corrections_down = 8;
constexpr double last_correction = 0.01;
/// A structure whose nodes move by so many times its size, or turn by more than half a turn, does not come to rest.
constexpr double farthest_move = 2;
/// Part of the largest forces on the way at which Newton's iteration takes over.
constexpr double nearly_balanced = 1e-3;

}  // namespace

Descent::Descent(SolverContext& context)
    : context_(context), lengths_(static_cast<std::size_t>(context.numbering.equations()), 0.0), unknowns_(lengths_.size(), 0.0) {
  for (std::size_t e = 0; e < lengths_.size(); ++e)
    if (const int equation = static_cast<int>(e); !context.numbering.unknown(equation).multiplier)
      lengths_[e] = context.newton.references().length(equation);
  for (Owned<Vec>* vector : {&residual_, &change_, &diagonal_}) *vector->out() = context.assembler.new_vector();
}

bool Descent::descend(const Newton::Apply& apply, std::vector<double> unknowns, Configuration& to) {
  unknowns_ = std::move(unknowns);
  apply(unknowns_, to);
  context_.assembler.residual(to, residual_);
  double viscosity = largest_work(context_.assembler.gather(residual_)) / first_part, largest = 0;
  for (int attempt = 0, in_vain = 0; attempt < most_tries && in_vain < most_in_vain; ++attempt) {
    const std::vector<double> begin = unknowns_;
    const std::optional<double> work = creep(viscosity, apply, to);
    if (!work) {
      unknowns_ = begin;
      viscosity *= thicker;
      ++in_vain;
      continue;
    }
    in_vain = 0;
    if (runs_away()) return false;
    largest = std::max(largest, *work);
    if (*work < nearly_balanced * largest) return true;
    viscosity *= thinner;
  }
  return false;
}

std::optional<double> Descent::creep(double viscosity, const Newton::Apply& apply, Configuration& to) {
  Assembler& assembler = context_.assembler;
  std::vector<double> diagonal(lengths_.size(), 0.0), moved(lengths_.size(), 0.0);
  for (std::size_t e = 0; e < diagonal.size(); ++e)
    if (lengths_[e] > 0) diagonal[e] = viscosity / (lengths_[e] * lengths_[e]);
  for (int k = 0; k <= most_corrections_down; ++k) {
    apply(unknowns_, to);
    assembler.residual(to, residual_);
    const auto r = assembler.gather(residual_);
    const double work = largest_work(r);
    if (!std::isfinite(work)) return {};
    const double way = largest_part(moved);
    if (k > 0 && largest_part(assembler.gather(change_)) <= last_correction * way) return work;
    std::vector<double> forces(moved);
    for (std::size_t e = 0; e < forces.size(); ++e) forces[e] *= diagonal[e];
    assembler.spread(forces, change_);
    check_petsc(VecAXPY(residual_, 1, change_));
    assembler.tangent(to, {1, 0, 0});
    assembler.spread(diagonal, diagonal_);
    check_petsc(MatDiagonalSet(assembler.matrix(), diagonal_, ADD_VALUES));
    if (!context_.solver.solve(residual_, change_)) return {};
    const auto change = assembler.gather(change_);
    for (std::size_t e = 0; e < change.size(); ++e) {
      moved[e] -= change[e];
      unknowns_[e] -= change[e];
    }
    if (!(largest_part(moved) <= largest_move)) return {};
  }
  return {};
}

bool Descent::runs_away() const {
  const double extent = context_.model.extent();
  for (std::size_t e = 0; e < unknowns_.size(); ++e) {
    const Unknown& u = context_.numbering.unknown(static_cast<int>(e));
    if (u.multiplier || u.part >= 0) continue;
    const double way = std::abs(unknowns_[e]);
    if (way > (u.rotational() ? std::numbers::pi : farthest_move * extent)) return true;
  }
  return false;
}

double Descent::largest_work(std::span<const double> forces) const {
  double largest = 0;
  for (std::size_t e = 0; e < forces.size(); ++e) largest = std::max(largest, std::abs(forces[e]) * lengths_[e]);
  return largest;
}

double Descent::largest_part(std::span<const double> changes) const {
  double largest = 0;
  for (std::size_t e = 0; e < changes.size(); ++e)
    if (lengths_[e] > 0) largest = std::max(largest, std::abs(changes[e]) / lengths_[e]);
  return largest;
}

}  // namespace engrane::solve
