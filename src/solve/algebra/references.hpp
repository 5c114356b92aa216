// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "assembly/assembler.hpp"
#include "base/snapshot.hpp"

namespace engrane::solve {

/// Reference values of residuals, constraint violations and corrections, all of them local: the loads of the same node or
/// element, and the lengths around it (docs/theory.md, "Newton"). A watch on a press is therefore solved as accurately as a
/// watch alone, and units of length and force do not matter.
class References {
 public:
  /// `precision`: fraction of the reference to which residuals are to be reduced.
  References(const Assembler& assembler, double precision);

  /// Updates the lengths for an iteration that begins near `c`.
  void begin(const Configuration& c);
  /// Updates the loads by what the elements contributed to the last residual (Assembler::carried).
  void take(const Configuration& c, const std::vector<double>& carried);

  /// Reference load of an equation's residual; for a constraint, of the force kΦ.
  double load(int equation) const {
    const Source& from = sources_[static_cast<std::size_t>(equation)];
    return std::max(pairs_[from.pair].of(from.turns), least_load);
  }
  /// Largest force, or moment, so far on the nodes of the element that owns a constraint's equation; at least load().
  double peak(int equation) const;
  /// peak() on the nodes of any element: a component.
  double peak_on(std::size_t part, bool turns) const;
  /// Largest moment so far that forces on the nodes of any element have with the lever at which they count as moments.
  double leverage_on(std::size_t part) const;
  /// Reference length of an unknown's correction, or of a constraint violation; 1 radian for rotations, the largest value so far
  /// for signals of controllers.
  double length(int equation) const { return lengths_[static_cast<std::size_t>(equation)]; }

  /// Change of an unknown over its reference. The unknown λ of a multiplier is a displacement; its change over the length or
  /// that of the force over the load counts, whichever is less. Where k is small, as for motions without mass, only the force
  /// shows that nothing changes any more. A signal of a controller changes nothing either if it changes forces by less than the
  /// precision: that of a derivative at rest is the rounding of an angle times its gain, and as large as itself.
  double relative_change(int equation, double change) const;

  /// Largest force on a node at the ends of iterations so far. Their trial positions, where stiff parts may resist with many
  /// times as much, do not count.
  double largest_force() const { return std::max(solved_force_, last_force_); }
  /// Largest force on a node in the last residual alone.
  double last_force() const { return last_force_; }
  /// Largest loads so far, to be restored after a failed iteration.
  const std::vector<double>& memory() const { return largest_of_slot_; }
  /// Whether any of them is not zero.
  bool remembers() const;
  void restore(std::vector<double> memory);

  void save(Snapshot& snapshot) const;
  void load_memory(const Snapshot& snapshot);

 private:
  static constexpr double least_load = 1e-200;  ///< stands for no load: quotients by it stay finite
  struct Pair {
    double force = 0, moment = 0;
    double of(bool turns) const { return turns ? moment : force; }
  };
  /// Where the loads of an equation are in pairs_.
  struct Source {
    std::size_t pair;
    bool turns;
  };
  /// An element with unknowns of its own, and the end of its range of multipliers.
  struct Owner {
    std::size_t part, end;
  };
  /// A node that a single element acts on, such as the middle node of a beam's piece.
  struct Inner {
    std::size_t node, part;
  };
  void find_spans();
  void find_inner();
  void find_sources();
  void find_lengths();
  void find_signals(const Configuration& c);
  void find_influence(const Configuration& c);
  Pair& at_node(int node) { return pairs_[static_cast<std::size_t>(node)]; }
  Pair& at_part(std::size_t part) { return pairs_[spans_.size() + part]; }
  Pair& everywhere() { return pairs_.back(); }

  const Assembler& assembler_;
  double precision_, rounding_share_;
  std::vector<double> spans_;  ///< of each node: distance to the farthest node that an element joins it with
  std::vector<double> reach_;  ///< of each node: that, or its distance from the origin if that is larger
  std::vector<Inner> inner_;
  std::vector<Pair> pairs_;      ///< loads at each node, then of each element, then the largest of all
  std::vector<Source> sources_;  ///< of each equation
  std::vector<Owner> owners_;
  std::vector<char> turns_;           ///< of each multiplier: whether it is a moment
  std::vector<double> lengths_;       ///< of each equation
  std::vector<std::size_t> signals_;  ///< equations of signals, ascending
  /// For each of them: the equations of forces that it changes directly, and by how much.
  std::vector<std::vector<std::pair<int, double>>> influence_;
  std::vector<double> largest_of_slot_;       ///< largest load so far, by motion slot
  double solved_force_ = 0, last_force_ = 0;  ///< largest at the ends of iterations, and in the last residual
};

}  // namespace engrane::solve
