// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Dense>
#include <Eigen/SparseCore>
#include <string>
#include <vector>

#include "assembly/assembler.hpp"
#include "base/snapshot.hpp"
#include "solve/constraints/motion.hpp"

namespace engrane::solve {

/// Constraints of which some follow from the others.
struct RedundantGroup {
  std::vector<int> members;  ///< multipliers, index into Configuration::multipliers
  int redundant = 0;         ///< how many of them are too many
  int widest = -1;           ///< the member that stays open by most when the independent ones are closed
  double open = 0;           ///< by how much, in its own unit
  double relative = 0;       ///< the same over the extent, or in radians
};

/// What the gradient B of the constraints says of a mechanism.
struct Mobility {
  bool analysed = false;
  int motions = 0, constraints = 0, rank = 0;
  std::vector<int> dependent;  ///< multipliers whose constraints follow from the others
  std::vector<RedundantGroup> groups;
  Eigen::SparseMatrix<double> null;  ///< combinations of multipliers that make no force, one column for each redundant constraint
  /// Independent constraints that are dependent in just the present position, for instance bars in line; 0 in most.
  int lost_here = 0;

  int freedom() const { return motions - rank; }
  int redundant() const { return constraints - rank; }
};

/// Columns of B whose remainder after all others is below this, relative to their size, count as dependent.
constexpr double rank_tolerance = 1e-9;
/// Open constraints that count as closed by the independent ones: over the extent, or in radians.
constexpr double consistent = 1e-8;

/// Finds dependent constraints by an elimination of Bᵀ (ConstraintFactors). Where there is a motion left, the rank counts
/// that a position a little along it shows, or a mechanism in a dead point would lose a constraint for good. Not collective:
/// every rank finds the same.
Mobility analyse_mobility(Assembler& assembler, const MotionSlots& motion, const Configuration& configuration, double tolerance);

/// The paragraph of the listing and of `engrane check`.
std::string describe_mobility(Assembler& assembler, const Configuration& configuration, const Mobility& mobility);

/// Keeps a model with redundant constraints solvable: the equations of the dependent ones are replaced by values for their
/// multipliers, and the multipliers are then made the least that carry the same loads.
class Redundancy {
 public:
  Redundancy(Assembler& assembler, const MotionSlots& motion) : assembler_(assembler), motion_(motion) {}

  const Mobility& mobility() const { return mobility_; }
  bool active() const { return !mobility_.dependent.empty(); }

  /// Analyses the constraints at `c` and releases the dependent ones; true when others than before are released.
  bool analyse(const Configuration& c, double tolerance = rank_tolerance);

  /// Empty when the released constraints are closed at `c`; else which conflict with one another, and by how much.
  std::string conflict(const Configuration& c);
  /// The same for their rates, given as Assembler::constraint_rates gives them.
  std::string rate_conflict(const Configuration& c, const std::vector<double>& rate, double speed);

  /// Replaces the multipliers of `c` by the least ones (forces, and moments over the extent, in the mean square) that act
  /// the same on all that moves. True when forces depend on them in other ways than linearly and the balance has to be
  /// found anew with the released multipliers as they are now.
  bool share(Configuration& c);

  /// Forces and moments that could be added to the multipliers of `c` without any effect on what moves: reactions that these
  /// change are not unique. Two combinations of all that there are, so that what one leaves alone by chance the other
  /// changes, the largest entry 1; none where all is determined.
  std::vector<Eigen::VectorXd> undetermined(const Configuration& c);

  /// What the last analysis found, for a restart. The assembler keeps what is released.
  void save(Snapshot& snapshot) const;
  void load(const Snapshot& snapshot);

 private:
  /// "make the places and axes agree, or make HINGE 3 a SPHERICAL": the end of a message about constraints that conflict.
  std::string cure_of(const RedundantGroup& one) const;

  Assembler& assembler_;
  const MotionSlots& motion_;
  Mobility mobility_;
};

}  // namespace engrane::solve
