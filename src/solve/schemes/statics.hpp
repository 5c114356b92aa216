// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "math/extrapolation.hpp"
#include "solve/schemes/scheme.hpp"
#include "solve/schemes/step_error.hpp"

namespace engrane::solve {

/// Equilibrium without inertia and damping, time being only the parameter of loads and drives.
///
/// With a tolerance, steps begin on the polynomial through the equilibria before. How far it was from the new one tells what lies
/// between the two: equilibria themselves are exact, whatever the steps. Displacements of the nodes are added up for it, their
/// rotation vectors too, each in the node's own axes.
class Statics : public Scheme {
 public:
  explicit Statics(SolverContext& context);

  StartReport start(Configuration& c) override;
  Outcome attempt(const Configuration& from, double h, Configuration& to) override;
  void accept() override;
  int order_of_error() const override { return static_cast<int>(points); }
  void pass_corner(const Configuration& c) override;
  std::unique_ptr<Within> within(const Configuration& from, const Configuration& to, std::span<const double> scalars) override;
  void save(Snapshot& snapshot) const override;
  void load(const Snapshot& snapshot) override;

 protected:
  Vec unknowns() { return unknowns_; }

 private:
  class Inside;
  static constexpr std::size_t points = 4;  ///< of the polynomial

  /// An equilibrium h later; Newton's iteration begins on the path, or where `from` is. `to` may be `from` itself, and is then no
  /// more what it was where nothing is found.
  NewtonReport find(const Configuration& from, double h, Configuration& to, bool predicted);
  /// The first step of a path has an equilibrium in its middle, for the others to be compared with.
  bool find_middle(const Configuration& from, double h);
  std::optional<double> error(const Configuration& from, double h) const;
  /// Forgets what lies before the equilibrium at way_.
  void begin_path(double time, std::span<const double> multipliers);
  /// Newton's iteration from the displacements `y` and the multipliers of `to`, which end as the solution.
  NewtonReport balance(const MotionSlots::Origin& from, std::span<double> y, Configuration& to);
  /// Flanks across a gap give no stiffness to find each other by: contacts begin as springs that fade away.
  NewtonReport balance_across_gaps(const MotionSlots::Origin& from, std::span<double> y, Configuration& to);

  bool has_contacts_;
  Owned<Vec> unknowns_;
  StepError error_;
  Extrapolation path_, forces_;  ///< displacements since the start by motion slot, and multipliers
  std::vector<double> way_;      ///< the former at the last equilibrium that stands
  std::vector<double> y_;        ///< the step tried last, its end and its multipliers
  double tried_time_ = 0;
  std::vector<double> tried_forces_;
  bool has_middle_ = false;  ///< path_ ends with the middle of a step that does not stand yet
};

}  // namespace engrane::solve
