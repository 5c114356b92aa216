// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "model/grip.hpp"
#include "model/solver_options.hpp"
#include "solve/constraints/start.hpp"

namespace engrane::solve {

/// Decides which dry frictions hold and which slide (docs/theory.md, "Friction at rest"). The decisions are stored in the
/// history of the elements and in the assembler, where sliding grips are idle constraints. Every rank decides the same.
class Grips {
 public:
  Grips(Assembler& assembler, Redundancy& redundancy, Start& start, const SolverOptions& options);

  bool any() const { return !places_.empty(); }
  /// Whether any grip slides backwards, is dragged along, or carries more than it can hold. Always true before settle().
  bool violated(const Configuration& c) const;
  /// Whether any grip carries so much that it may give way within a step.
  bool strained(const Configuration& c) const;
  /// Decides, and makes velocities, accelerations and multipliers of `c` and the directions of sliding consistent with the
  /// decisions. `massless`: the model has motions without mass. Throws SolutionFailure if no decision fits.
  void settle(Configuration& c, bool massless);
  /// Stops following grips: friction then depends on the sliding speeds only, and belts hold.
  void let_go(Configuration& c);

 private:
  struct Place {
    int part, first;  ///< `first`: index of the first multiplier
    const Layout* layout;
  };
  /// A grip. `speeds` and `accelerations`: of the fastest node, but at least those by the rounding of positions in a step.
  struct Seen : Grip {
    bool redundant = false;  ///< holds, but other constraints hold the same motion
  };
  /// Search for the direction in which a grip of several coordinates begins to slide.
  struct Aim {
    Vec3 direction = Vec3::Zero(), acceleration = direction;  ///< last tried
    double slope = 0;                                         ///< change of the acceleration with the direction; 0: unknown
    bool tried = false, found = false;
  };
  static bool rests(const Seen& grip);
  static bool overloaded(const Seen& grip);
  /// Force of a grip that holds over its limit; and the largest such ratio of the grips that carry too much, less rounding.
  static double load(const Seen& grip);
  static double largest_load(const std::vector<Seen>& grips);
  static bool turns_back(const Seen& grip);
  /// Whether a grip that turns back comes to rest, rather than sliding on in another direction.
  static bool stops(const Seen& grip);
  /// Whether other constraints move what the grip holds, or begin to (pulled()). It then holds nothing.
  static bool dragged(const Seen& grip);
  static bool pulled(const Seen& grip);
  /// Whether its acceleration is rounding: nothing moves it, or it balances the pull on it.
  bool still(const Seen& now) const;

  std::vector<Seen> look(const Configuration& c) const;
  void write(const std::vector<Seen>& grips, Configuration& c);
  /// Index of the first grip at rest that holds; their number if none does.
  static std::size_t first_that_holds(const std::vector<Seen>& grips, const std::vector<bool>& at_rest);
  /// Adjusts the direction of a grip that begins to slide until it accelerates that way; false once it does.
  bool aim(Seen& grip, const Seen& now, Aim& aim) const;
  void fit(Configuration& c, bool massless);
  /// `c` with velocities that fit all other constraints where those `grips` do not hold that are about to.
  Configuration without_stopping(const Configuration& c, const std::vector<Seen>& grips);
  /// A grip that friction cannot stop as `now` holds it, where the velocities of `before` become those of `after`: the slider of
  /// a crank beside its dead centre, with which the crank would stop. Their number if there is none. `slips`: where those that
  /// are about to stop slide on.
  std::size_t unstoppable(const std::vector<Seen>& slips, const std::vector<Seen>& now, const Configuration& before,
                          const Configuration& after) const;
  /// Kinetic energy of the difference of the velocities, in the positions of `to`.
  double energy_of_change(const Configuration& from, const Configuration& to) const;
  /// Name of the element that owns the grip: "HINGE 3".
  std::string name(std::size_t grip) const;

  Assembler& assembler_;
  Redundancy& redundancy_;
  Start& start_;
  std::vector<Place> places_;  ///< elements with grips
  std::size_t count_ = 0;
  double step_, longest_;  ///< H of the analysis; the length that its steps may have
  double rest_;            ///< speed that moves nothing beyond the rounding of positions in the whole analysis
};

}  // namespace engrane::solve
