// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "assembly/assembler.hpp"

namespace engrane::solve {

/// Cells and beams that share nodes, and their nodes other than node 0.
struct Body {
  std::vector<int> nodes, parts;  ///< indices into Model::nodes and Model::parts, ascending
  bool keeps_shape = true;        ///< all of them do (Element::keeps_shape)
};

/// Elastic bodies that the start carries along. A constraint moves the nodes that it reaches, and would leave the other nodes of
/// their body behind: it would begin torn. Where the deck gives no initial values for the nodes of a body, its elastic energy
/// counts so much that it moves as a rigid body, or is strained only as its joints demand.
class CarriedBodies {
 public:
  /// A body that is not carried along, of which constraints move few nodes.
  struct Torn {
    int node = 0;  ///< index into Model::nodes: that which they move most
    int nodes = 0, behind = 0;
  };

  /// `velocity`: velocities are sought, otherwise positions. `moved`: how far joints and drives have moved each node, or
  /// turned it at the distance of the extent; up to `least` is rounding.
  CarriedBodies(const Assembler& assembler, Assembler::Metric metric, bool velocity, std::span<const double> moved, double least);

  bool none() const { return bodies_.empty(); }
  const std::vector<Body>& bodies() const { return bodies_; }
  /// Membranes, and bodies with values of their own, that begin torn.
  const std::vector<Torn>& torn() const { return torn_; }

  /// Weight of the stiffness in the projection, by part (Assembler::projection).
  std::span<const double> give() const { return give_; }
  /// Gives the stiffness more weight. False if it has as much as rounding allows.
  bool stiffen();
  /// −give · K · rates of the bodies, by motion slot, on every rank.
  std::vector<double> resistance(const Configuration& c, std::span<const double> rates) const;
  /// Largest rate of a component of their nodes' positions, by motion slot.
  double fastest(std::span<const double> rates) const;
  /// −give · forces of the bodies at rest in the positions of `c`, without weight, by motion slot, on every rank.
  std::vector<double> pull(const Configuration& c) const;

 private:
  /// Minus the sum over the pieces of give · forces(part, its slots), by motion slot.
  template <class Forces>
  std::vector<double> sum(Forces&& forces) const;
  /// Weight with which stiffness counts 1e8 times as much as what the projection minimises; 0 without mass.
  double weight(const Body& body, Assembler::Metric metric) const;

  const Assembler& assembler_;
  std::vector<Body> bodies_;
  std::vector<Torn> torn_;
  std::vector<double> give_;
  double stiffened_ = 1;
};

}  // namespace engrane::solve
