// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <vector>

#include "assembly/assembler.hpp"
#include "base/snapshot.hpp"

namespace engrane::solve {

/// What residuals, open constraints and corrections are compared with, each by the size of what it is part of: the loads of its
/// own node or element, and the lengths around it (docs/theory.md, "Newton"). So a watch on a press is solved as well as a watch
/// alone, and no unit of length or force counts.
class References {
 public:
  /// `precision`: part of a reference down to which residuals are to go.
  References(const Assembler& assembler, double precision);

  /// Finds the lengths for an iteration that begins near `c`.
  void begin(const Configuration& c);
  /// Takes what the last residual's elements contributed (Assembler::carried).
  void take(const Configuration& c, const std::vector<double>& carried);

  /// What the residual of an equation is compared with; of a constraint, what the force kΦ is.
  double load(int equation) const {
    const Source& from = sources_[static_cast<std::size_t>(equation)];
    return std::max(pairs_[from.pair].of(from.turns), least_load);
  }
  /// The largest force, or moment, so far on the nodes of the element that has a constraint's equation; load() where that is
  /// none.
  double peak(int equation) const;
  /// What the correction of an unknown, or an open constraint, is compared with: a length, or 1 radian.
  double length(int equation) const { return lengths_[static_cast<std::size_t>(equation)]; }

  /// The change of an unknown over what it is compared with. Of a multiplier the unknown is λ/k, the displacement that its force
  /// stands for; where k is small, as of what has no mass, the force itself tells that nothing changes any more.
  double relative_change(int equation, double change) const;

  /// The largest force that an element has contributed so far.
  double largest_force() const { return largest_force_; }
  /// The memory of loads so far, to be put back where an iteration failed.
  const std::vector<double>& memory() const { return largest_of_slot_; }
  /// Whether any of it is not zero.
  bool remembers() const;
  void restore(std::vector<double> memory);

  void save(Snapshot& snapshot) const;
  void load_memory(const Snapshot& snapshot);

 private:
  static constexpr double least_load = 1e-200;  ///< stands for none: what is divided by it stays finite
  struct Pair {
    double force = 0, moment = 0;
    double of(bool turns) const { return turns ? moment : force; }
  };
  /// Where the loads of an equation stand in pairs_.
  struct Source {
    std::size_t pair;
    bool turns;
  };
  /// An element with unknowns of its own, and the end of its multipliers.
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
  Pair& at_node(int node) { return pairs_[static_cast<std::size_t>(node)]; }
  Pair& at_part(std::size_t part) { return pairs_[spans_.size() + part]; }
  Pair& everywhere() { return pairs_.back(); }

  const Assembler& assembler_;
  double rounding_share_;
  std::vector<double> spans_;    ///< of each node: to the farthest node that an element joins it with
  std::vector<double> reach_;    ///< of each node: that, or its distance from the origin
  std::vector<Inner> inner_;     ///< all such nodes
  std::vector<Pair> pairs_;      ///< loads at each node, of each element, and the largest of all
  std::vector<Source> sources_;  ///< of each equation
  std::vector<Owner> owners_;
  std::vector<char> turns_;              ///< of each multiplier: whether it is a moment
  std::vector<double> lengths_;          ///< of each equation
  std::vector<double> largest_of_slot_;  ///< so far, of the motion
  double largest_force_ = 0;
};

}  // namespace engrane::solve
