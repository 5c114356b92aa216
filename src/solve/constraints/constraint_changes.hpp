// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "solve/algebra/newton.hpp"
#include "solve/constraints/motion.hpp"

namespace engrane::solve {

/// Constraints of short steps. Positions are rounded, so that Φ of a configuration has a rounding error of the size ε L, which
/// the multiplier of a step turns into the force ε L m/(β h²). The change of Φ over the step, ∫ B y ds along its increment y,
/// is known to ε B y, which is much less. Where the force would be visible, a step closes Φ by its change (decision 21).
class ConstraintChanges {
 public:
  /// `gain`: of the noise of several steps over that of one, by the scheme (AlphaScheme::gain_of_noise()).
  ConstraintChanges(Assembler& assembler, const Newton& newton, const MotionSlots& motion, double gain);

  /// Selects the constraints that a step from `from` by about the increment y closes by their change. The scales of the
  /// multipliers must have been chosen for this step.
  void begin(const Configuration& from, std::span<const double> y);
  bool any() const { return !parts_.empty(); }
  /// States their values (Assembler::stated) for the increment y over the time h.
  void state(const Configuration& from, double h, std::span<const double> y);
  /// From now on all constraints are closed by positions again.
  void end();

 private:
  /// Scales of the multipliers. A constraint between parts with hardly any mass has that of the constraints that join these parts
  /// to others: its errors move what is beyond.
  const std::vector<double>& stiffnesses();
  /// Displacement by the increment of what a constraint joins, at most: a length, or radians.
  double moved(int multiplier, std::span<const double> y) const;

  Assembler& assembler_;
  const Newton& newton_;
  const MotionSlots& motion_;
  double gain_;
  std::vector<double> scale_, stiffness_;  ///< the scales that stiffnesses() had last, and what it made of them
  std::vector<std::vector<int>> joined_;   ///< multipliers at each node, forces and moments apart, where there are several
  std::vector<int> parts_;                 ///< elements whose constraints are closed by their change, ascending
  std::vector<double> given_;  ///< part of Φ at the beginning that the step is to close; NaN: Φ is taken from positions
  Configuration between_;
  std::vector<double> phi_, rate_[2], second_[2];
};

}  // namespace engrane::solve
