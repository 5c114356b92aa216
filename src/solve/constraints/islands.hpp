// SPDX-License-Identifier: BSD-3-Clause
// The parts of a model that constraints join to one another, and a position near the present one for each of them.
#pragma once

#include <cstddef>
#include <vector>

#include "assembly/assembler.hpp"
#include "solve/constraints/constraint_factors.hpp"
#include "solve/constraints/motion.hpp"

namespace engrane::solve {

/// Sets of motions and constraints; no constraint joins motions of two sets.
class Islands {
 public:
  explicit Islands(const Assembler& assembler);

  std::size_t count() const { return count_; }
  /// Island of a motion slot; the slots of a node are in one.
  std::size_t of_slot(std::size_t slot) const { return of_slot_[slot]; }
  std::size_t of_multiplier(int multiplier) const { return of_slot_[motion_slots_ + static_cast<std::size_t>(multiplier)]; }

 private:
  std::vector<std::size_t> of_slot_;  ///< of motions, then of multipliers
  std::size_t motion_slots_ = 0, count_ = 0;
};

/// Moves each island of `c` that has dependent constraints by 0.02 (of the extent, or radians) along a motion left to it, and
/// closes it again. Where it does not close the motion is one of first order only, and the island stays. False if all stay.
/// What an island does depends on no other one. `here`: factors at `c`; `tolerance`: that of their rank.
bool move_along(Assembler& assembler, const MotionSlots& motion, const Islands& islands, const ConstraintFactors& here,
                Configuration& c, double tolerance);

}  // namespace engrane::solve
