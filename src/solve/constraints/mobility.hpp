// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Dense>
#include <Eigen/SparseCore>
#include <string>
#include <vector>

#include "assembly/assembler.hpp"
#include "base/snapshot.hpp"
#include "solve/constraints/constraint_factors.hpp"
#include "solve/constraints/motion.hpp"

namespace engrane::solve {

/// Constraints some of which are redundant.
struct RedundantGroup {
  std::vector<int> members;  ///< multipliers, index into Configuration::multipliers
  int redundant = 0;         ///< number of redundant ones among them
  int widest = -1;           ///< the member with the largest violation once the independent ones are closed
  double open = 0;           ///< its violation, in its own unit
  double relative = 0;       ///< the same over the extent, or in radians
};

/// Degrees of freedom and redundancy of a mechanism, from the gradient B of its constraints.
struct Mobility {
  bool analysed = false;
  int motions = 0, constraints = 0, rank = 0;
  std::vector<int> dependent;  ///< multipliers whose constraints follow from the others
  std::vector<RedundantGroup> groups;
  Eigen::SparseMatrix<double> null;  ///< multipliers that make no force, one column for each redundant constraint
  /// Number of constraints dependent only in the present position, for instance with bars in line; mostly 0.
  int lost_here = 0;

  int freedom() const { return motions - rank; }
  int redundant() const { return constraints - rank; }
};

/// Columns of B whose remainder after all others is below this, relative to their size, count as dependent.
constexpr double rank_tolerance = 1e-9;
/// Violation below which constraints count as closed by the independent ones: over the extent, or in radians.
constexpr double consistent = 1e-8;

/// Finds dependent constraints by an elimination of Bᵀ (ConstraintFactors). If the mechanism can still move, the rank is that
/// of a position a little along the motion; otherwise a mechanism at a dead point would lose a constraint for good. Not
/// collective: every rank finds the same.
Mobility analyse_mobility(Assembler& assembler, const MotionSlots& motion, const Configuration& configuration, double tolerance);

/// Elements with friction among those whose reactions are not unique, by name; empty if there is none. The friction depends on
/// how the reactions share the load, and so does the motion.
std::string friction_on_redundant(const Assembler& assembler, const Mobility& mobility);

/// Paragraph on mobility for the listing and for `engrane check`.
std::string describe_mobility(Assembler& assembler, const Configuration& configuration, const Mobility& mobility);

/// Keeps a model with redundant constraints solvable: the equations of the dependent ones are replaced by given values of their
/// multipliers, and the multipliers then by the smallest ones that carry the same loads.
class Redundancy {
 public:
  Redundancy(Assembler& assembler, const MotionSlots& motion) : assembler_(assembler), motion_(motion) {}

  const Mobility& mobility() const { return mobility_; }
  bool active() const { return !mobility_.dependent.empty(); }

  /// Analyses the constraints at `c` and releases the dependent ones; true if they differ from those released before.
  bool analyse(const Configuration& c, double tolerance = rank_tolerance);

  /// The same within a run, where constraints are as closed as steps leave them.
  bool renew(const Configuration& c);

  /// Empty if the released constraints are closed at `c`; otherwise says which of them conflict, and by how much.
  std::string conflict(const Configuration& c);
  /// Says which released constraints conflict in their rates (Assembler::constraint_rates), beside `speed`; empty if none does.
  std::string rate_conflict(const Configuration& c, const std::vector<double>& rate, double speed);

  /// Replaces the multipliers of `c` by the smallest ones (forces, and moments over the extent, in the mean square) with the
  /// same effect on all that moves, friction apart. True if other forces depend on them, as friction does, so that the balance
  /// must be solved again with the released multipliers as they are now. Where teeth change flank, so does the direction of their
  /// force, and forces of either flank may be the smallest of their kind: those of the flanks that turn_flanks() finds are taken.
  /// `last`: no balance follows, so that flanks stay as they are.
  bool share(Configuration& c, bool last = false);

  /// Forces and moments that could be added to the multipliers of `c` without any effect on what moves: reactions changed by
  /// these are not unique. Returns two combinations of all that there are, so that what one leaves unchanged by chance the
  /// other changes, scaled to a largest entry of 1; none if all reactions are determined.
  std::vector<Eigen::VectorXd> undetermined(const Configuration& c);

  /// Result of the last analysis, for a restart. The assembler saves which constraints are released.
  void save(Snapshot& snapshot) const;
  void load(const Snapshot& snapshot);

 private:
  /// Takes the smallest multipliers with the same effect through the gradients of the constraints, on which flanks have no
  /// influence, if they press other flanks than `least`. Their separating forces are still to be balanced.
  /// (docs/decisions/0046-flanks-of-redundant-teeth.md)
  bool turn_flanks(const Configuration& here, const Eigen::VectorXd& weight, const Eigen::VectorXd& forces,
                   Eigen::VectorXd& least) const;

  /// Columns by which multipliers are combined: the forces that they cause, or, where friction depends on those that are not
  /// unique, the gradients of the constraints. Self-stress that changes friction has an effect, and would stay as it has come
  /// about.
  ConstraintColumns columns_kind() const;

  /// "make the places and axes agree, or make HINGE 3 a SPHERICAL": the end of a message about conflicting constraints.
  std::string cure_of(const RedundantGroup& one) const;

  Assembler& assembler_;
  const MotionSlots& motion_;
  Mobility mobility_;
  int turns_ = 0;  ///< calls of share() up to the last that have turned flanks: each comes nearer, and a few are enough
};

}  // namespace engrane::solve
