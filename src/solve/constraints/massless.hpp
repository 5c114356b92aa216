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

/// Motions that the joints leave free and that move no mass, at one configuration: the z with M z = 0 and B z = 0. No balance
/// of forces determines their acceleration. Springs and dampers hold them in quasi-static equilibrium, or nothing does.
///
/// Not collective: every rank finds the same.
class MasslessMotions {
 public:
  MasslessMotions(Assembler& assembler, const Configuration& configuration);

  bool any() const { return count_ > 0; }
  int count() const { return count_; }
  /// Name of the largest component of one of them: "node 3 (x)".
  const std::string& example() const { return example_; }

  /// Explains a motion that neither a spring nor a damper holds: "node 2 (y) has no inertia, and ... holds it: ..."; empty if
  /// there is none. `configuration`: that of the constructor.
  std::string explain_unheld(Assembler& assembler, const Configuration& configuration) const;

  /// Removes these motions from a vector with an entry for each motion slot, such as accelerations.
  void remove(std::span<double> slots) const;
  /// Removes everything else from it.
  void keep(std::span<double> slots) const;
  /// Removes the forces that act along them from a vector with an entry for each motion slot.
  void remove_forces(std::span<double> slots) const;

 private:
  MotionRows rows_;
  Eigen::SparseMatrix<double> seen_;    ///< [M Mᵀ Bᵀ], columns of length 1; motions orthogonal to all of them are massless
  std::optional<RowSpace> determined_;  ///< its column space: all other motions
  int count_ = 0;
  std::string example_;
};

}  // namespace engrane::solve
