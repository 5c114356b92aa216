// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "assembly/assembler.hpp"
#include "base/snapshot.hpp"

namespace engrane::solve {

/// What residuals, open constraints and corrections are compared with, each by the size of what it is part of: the loads of its
/// own node or element, and the lengths around it (docs/theory.md, "Newton"). So a watch on a press is solved as well as a watch
/// alone, and no unit of length or force counts.
class References {
 public:
  /// `precision`: part of a reference down to which residuals are to go.
  References(const Assembler& assembler, double precision);

  /// Takes what the last residual's elements contributed (Assembler::carried).
  void take(const Configuration& c, const std::vector<double>& carried);

  /// What the residual of a motion's equation is compared with; of a constraint, what the force kΦ is.
  double load(const Unknown& u) const;
  /// What a displacement, and an open constraint, is compared with: a length, or 1 radian.
  double length(const Unknown& u) const;

  /// The largest force that an element has contributed so far.
  double largest_force() const { return largest_[Measure::force]; }
  /// The memory of loads so far, to be put back where an iteration failed.
  const std::vector<double>& memory() const { return largest_of_slot_; }
  void restore(std::vector<double> memory);

  void save(Snapshot& snapshot) const;
  void load_memory(const Snapshot& snapshot);

 private:
  struct Pair {
    double force = 0, moment = 0;
    double of(bool rotational) const { return rotational ? moment : force; }
  };
  void find_lengths();
  void find_largest();

  const Assembler& assembler_;
  double rounding_share_;
  std::vector<double> span_;   ///< of each node: to the farthest node that an element joins it with
  std::vector<double> place_;  ///< of each node: its distance from the origin, now
  std::vector<Pair> at_node_, at_part_;
  std::vector<double> largest_of_slot_;  ///< of the motion
  Magnitudes everywhere_, largest_;      ///< of the whole model: in the last residual, and so far
};

}  // namespace engrane::solve
