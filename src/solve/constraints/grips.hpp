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
  /// What settle() has decided so far, and what it knows of the grips.
  struct Settling {
    std::vector<Seen> given, grips;  ///< before it, and with their new states
    std::vector<bool> at_rest;       ///< they may hold, or slide in any direction; the others slide on
    std::vector<bool> turned;        ///< they had turned back
    std::vector<bool> cannot_hold;   ///< while the other grips are as they are
    std::vector<Aim> aims;
    std::size_t last = 0;  ///< grip that was changed

    /// The state of a grip has been changed; `cannot`: it cannot hold.
    void changed(std::size_t i, bool cannot);
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
  /// Decides by speeds and forces of `c`: what comes to rest holds, and the most loaded of those that carry too much gives way.
  Settling first_decisions(const Configuration& c) const;
  /// Grips where those that are about to stop slide on, and gives `c` the velocities there.
  std::vector<Seen> find_slips(const Settling& all, Configuration& c);
  /// Index of the first grip at rest that holds; their number if none does.
  static std::size_t first_that_holds(const Settling& all);
  /// Whether a grip that began to slide accelerates the other way.
  bool turns_again(const Settling& all, std::size_t i, const Seen& now) const;
  /// Least load with which a grip gives way together with others: none does while any turns again.
  double least_load(const Settling& all, const std::vector<Seen>& now) const;
  /// Changes the state of a grip at rest if it is wrong as the grip is `now`; false if it is not.
  bool change(Settling& all, std::size_t i, const Seen& now, double least) const;
  /// Changes all wrong states that may change `together`, or else the first one; false if there is none.
  bool change(Settling& all, const std::vector<Seen>& now, bool together) const;
  /// Adjusts the directions of all that begin to slide; false if there is nothing to adjust.
  bool aim(Settling& all, const std::vector<Seen>& now) const;
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
