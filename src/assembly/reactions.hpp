// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "assembly/assembler.hpp"

namespace engrane {

/// Reaction force and torque (global components) on a supported node.
struct Reaction {
  int node = 0;  ///< index into Model::nodes
  Vec3 force = Vec3::Zero(), torque = Vec3::Zero();

  /// Power that the reaction feeds into the model.
  double power(const NodeState& state) const { return force.dot(state.v) + torque.dot(state.R * state.W); }
};

/// Resultant of everything that the ground exerts on the model, in global components; the moment is about the origin.
struct Resultant {
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
};

/// Reactions of supports: the residual of the supported components, summed over the elements at each supported node.
class Reactions {
 public:
  explicit Reactions(Assembler& assembler);

  /// Indices of the supported nodes, ascending.
  const std::vector<int>& nodes() const { return nodes_; }
  bool supported(int node) const;
  /// One reaction per supported node, on every rank; each rank evaluates its own elements. Collective.
  std::vector<Reaction> at(const Configuration& c);
  /// Resultant of these reactions, of the forces of node 0 on the elements attached to it and of constraints that hold the model
  /// from outside (OutsideForce). On every rank. Collective.
  Resultant resultant(const Configuration& c, const std::vector<Reaction>& reactions);

 private:
  Assembler& assembler_;
  std::vector<int> nodes_;
  std::vector<int> parts_;     ///< parts of this rank with a supported node
  std::vector<int> grounded_;  ///< parts of this rank attached to node 0
  std::vector<int> outside_;   ///< parts of this rank with an OutsideForce
  std::vector<int> place_;     ///< index of each node in nodes_, or -1
};

}  // namespace engrane
