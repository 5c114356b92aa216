// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "model/grip.hpp"
#include "solve/constraints/start.hpp"

namespace engrane::solve {

/// Decides which dry frictions hold and which slide (docs/theory.md, "Friction at rest"). What is decided stands in the history
/// of the elements, and in the assembler, where grips that slide are idle constraints. Every rank decides the same.
class Grips {
 public:
  /// `step`: the H of the analysis.
  Grips(Assembler& assembler, Redundancy& redundancy, Start& start, double step);

  bool any() const { return !places_.empty(); }
  /// Whether some grip slides back, is dragged along, or bears more than it holds. Always so before settle().
  bool violated(const Configuration& c) const;
  /// Whether a grip bears so much that it may give way within a step.
  bool strained(const Configuration& c) const;
  /// Decides: velocities, accelerations and multipliers of `c` then fit, and so do the directions of sliding. `massless`: the
  /// model has motions without mass. Throws SolutionFailure when no decision fits.
  void settle(Configuration& c, bool massless);
  /// No grip is followed any more: friction as the speeds of sliding ask, and belts hold.
  void let_go(Configuration& c);

 private:
  struct Place {
    int part, first;  ///< first: multiplier, of the model
    const Layout* layout;
  };
  /// A grip, with `speeds` and `accelerations` those of the fastest node, or what moves it in a step by the rounding of places.
  struct Seen : Grip {
    bool redundant = false;  ///< holds, but other constraints hold the same
  };
  /// The search for the direction in which a grip of several coordinates begins to slide.
  struct Aim {
    Vec3 direction = Vec3::Zero(), acceleration = direction;  ///< as tried last
    double slope = 0;                                         ///< of the acceleration over the direction; 0: not known yet
    bool tried = false, found = false;
  };
  static bool rests(const Seen& grip);
  static bool overloaded(const Seen& grip);
  static bool turns_back(const Seen& grip);
  /// Does a grip that turns back come to rest, or only slide on elsewhere?
  static bool stops(const Seen& grip);
  /// Do the others move what it holds, or begin to? Then it holds nothing.
  static bool dragged(const Seen& grip);
  static bool pulled(const Seen& grip);

  std::vector<Seen> look(const Configuration& c) const;
  void write(const std::vector<Seen>& grips, Configuration& c);
  /// Changes the direction of a grip that begins to slide, until it accelerates that way; false where it does.
  static bool aim(Seen& grip, const Seen& now, Aim& aim);
  void fit(Configuration& c, bool massless);
  /// "HINGE 3", whose grip it is.
  std::string name(std::size_t grip) const;

  Assembler& assembler_;
  Redundancy& redundancy_;
  Start& start_;
  std::vector<Place> places_;  ///< elements with grips
  std::size_t count_ = 0;
  double step_;
};

}  // namespace engrane::solve
