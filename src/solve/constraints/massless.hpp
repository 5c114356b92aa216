// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/SparseCore>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "assembly/assembler.hpp"
#include "solve/constraints/constraint_factors.hpp"
#include "solve/constraints/least_norm.hpp"

namespace engrane::solve {

/// Motions that the joints leave free and that move no mass, at one configuration: those z with M z = 0 and B z = 0. No balance
/// of forces gives their acceleration; springs and dampers hold them in quasi-static equilibrium, or nothing does.
///
/// Not collective: every rank finds the same.
class MasslessMotions {
 public:
  MasslessMotions(Assembler& assembler, const Configuration& configuration);

  bool any() const { return count_ > 0; }
  int count() const { return count_; }
  /// Where the largest part of one of them is: "node 3 (x)".
  const std::string& example() const { return example_; }

  /// "node 2 (y) has no inertia, and ... holds it: ...", of one that neither a spring nor a damper holds at the
  /// configuration of this; empty when there is none.
  std::string explain_unheld(Assembler& assembler, const Configuration& configuration) const;

  /// Takes these motions out of a vector with an entry for each motion slot, such as accelerations.
  void remove(std::span<double> slots) const;
  /// Leaves nothing but them in it.
  void keep(std::span<double> slots) const;
  /// Takes the forces that act along them out of a vector with an entry for each motion slot.
  void remove_forces(std::span<double> slots) const;

 private:
  MotionRows rows_;
  Eigen::SparseMatrix<double> seen_;    ///< [M Mᵀ Bᵀ], columns of length 1: motions that it does not see are massless
  std::optional<RowSpace> determined_;  ///< of its transpose: all other motions
  int count_ = 0;
  std::string example_;
};

}  // namespace engrane::solve
