// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "assembly/reactions.hpp"
#include "math/extrapolation.hpp"
#include "solve/schemes/branch_watch.hpp"
#include "solve/schemes/scheme.hpp"
#include "solve/schemes/step_error.hpp"

namespace engrane::solve {

/// Equilibrium without inertia and damping; time is only the parameter of loads and drives.
///
/// With a tolerance, steps begin on the polynomial through the equilibria before. Its distance from the new one is a measure of
/// the error in between: equilibria themselves are exact, whatever the steps. Displacements of the nodes are added up for it,
/// and so are their rotation vectors, each in the node's own axes.
class Statics : public Scheme {
 public:
  explicit Statics(SolverContext& context);

  StartReport start(Configuration& c) override;
  Outcome attempt(const Configuration& from, double h, Configuration& to) override;
  Outcome snap(const Configuration& from, double h, Configuration& to) override;
  /// Only models with gaps are watched: Newton's iteration may leave the branch where a contact opens on its way.
  bool leaps(const Configuration& from, const Configuration& to) override;
  void accept() override;
  int order_of_error() const override { return static_cast<int>(points); }
  void pass_corner(const Configuration& c) override;
  std::unique_ptr<Within> within(const Configuration& from, const Configuration& to, std::span<const double> scalars,
                                 bool drift) override;
  void save(Snapshot& snapshot) const override;
  void load(const Snapshot& snapshot) override;

 protected:
  Vec unknowns() { return unknowns_; }

 private:
  class Inside;
  static constexpr std::size_t points = 4;  ///< of the polynomial

  /// Finds the equilibrium after h; Newton's iteration begins on the path (`predicted`), or at `from`. `to` may be `from`
  /// itself, which is then lost even if nothing is found.
  NewtonReport find(const Configuration& from, double h, Configuration& to, bool predicted);
  /// Finds the equilibrium that the structure comes to from `from` down the slope of its energy (Descent).
  NewtonReport creep(const Configuration& from, double h, Configuration& to);
  /// Finds an equilibrium in the middle of the first step of a path, for the others to be compared with.
  bool find_middle(const Configuration& from, double h);
  std::optional<double> error(const Configuration& from, double h) const;
  /// Discards what lies before the equilibrium at way_.
  void begin_path(double time, std::span<const double> multipliers);
  /// Moves a configuration from `from` by unknowns, which also writes them into `y`, by motion slot. Both must outlive the
  /// result, and `y` holds what is prescribed.
  Newton::Apply move(const MotionSlots::Origin& from, std::span<double> y) const;
  /// The unknowns for the displacements `y`, by motion slot, and the multipliers of `c`.
  std::vector<double> unknowns_of(std::span<const double> y, const Configuration& c) const;
  /// Newton's iteration from the displacements `y` and the multipliers of `to`, which end as the solution.
  NewtonReport balance(const MotionSlots::Origin& from, std::span<double> y, Configuration& to);
  /// balance() where flanks across a gap have no stiffness towards each other: contacts begin as springs that fade away.
  NewtonReport balance_across_gaps(const MotionSlots::Origin& from, std::span<double> y, Configuration& to);
  /// One of these balances, with require_resistance().
  NewtonReport resisted_balance(bool across_gaps, const MotionSlots::Origin& from, std::span<double> y, Configuration& to);
  /// Both balances in the better order. Where contacts only touch at the beginning, rounding decides whether the first tangent
  /// has their stiffness, and with it how far Newton's iteration goes: they begin as springs. So do contacts where the iteration
  /// finds nothing, or what nothing resists, or goes far, or ends where some only touch, which it may come to past others.
  NewtonReport balance_contacts(const MotionSlots::Origin& from, std::span<double> y, Configuration& to);

  /// Repeats a step that began in a singular position from the displacements of the last one, which stay on its branch.
  void stay_on_branch(const Configuration& from, double h, NewtonReport& report, Configuration& to);

  /// Refuses an equilibrium whose stiffness matrix is singular up to rounding, which factors need not notice: a structure without
  /// enough supports, or a part that contacts have let go. Once in a run, for the first solution in which no contact only
  /// touches.
  void require_resistance(const Configuration& c, NewtonReport& report);
  /// Whether a contact is closed or open by no more than rounding (Element::touches).
  bool touches(const Configuration& c) const;
  /// find() without a prediction or, where it finds nothing, the positions as they are if the model rests() there.
  NewtonReport find_or_rest(const Configuration& from, double h, Configuration& to);
  /// Whether no load acts, and forces balance at `c` as it is, to rounding; finds the reactions. A model that rests in its plays
  /// before its load grows from zero has no stiffness yet, and needs none.
  bool rests(Configuration& c);

  std::vector<int> contacts_;          ///< elements with gaps
  std::optional<Reactions> supports_;  ///< with gaps, as long as leaps are looked for
  std::vector<double> loads_;          ///< Newton::loads() before the step tried last, with gaps
  bool leapt_ = false;                 ///< leaps() of that step
  double largest_force_ = 0;           ///< on a node, in accepted steps
  bool resists_ = false;               ///< require_resistance() was passed
  Owned<Vec> unknowns_;
  StepError error_;
  BranchWatch branch_;
  Extrapolation path_, forces_;  ///< displacements since the start by motion slot, and multipliers
  std::vector<double> way_;      ///< the former at the last accepted equilibrium
  std::vector<double> y_;        ///< the step tried last, its end and its multipliers
  double tried_time_ = 0;
  std::vector<double> tried_forces_;
  bool has_middle_ = false;  ///< path_ ends with the middle of a step that is not accepted yet
};

}  // namespace engrane::solve
