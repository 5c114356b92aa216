// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "assembly/assembler.hpp"

namespace engrane::observe {

/// Reaction force and torque (global components) on a supported node.
struct Reaction {
  int node = 0;  ///< index into Model::nodes
  Vec3 force = Vec3::Zero(), torque = Vec3::Zero();

  /// Power that it feeds into the model.
  double power(const NodeState& state) const { return force.dot(state.v) + torque.dot(state.R * state.W); }
};

/// The sum of all that the ground exerts on the model, global components; the moment about the origin.
struct Resultant {
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
};

/// What supports carry: the residual in the components that they hold, summed over the elements at the supported nodes.
class Reactions {
 public:
  explicit Reactions(Assembler& assembler);

  /// Indices of the supported nodes, ascending.
  const std::vector<int>& nodes() const { return nodes_; }
  bool supported(int node) const;
  /// One per supported node, on every rank; each rank evaluates its own elements. Collective.
  std::vector<Reaction> at(const Configuration& c);
  /// Of these reactions, and of what the elements on node 0 exert on it. On every rank. Collective.
  Resultant resultant(const Configuration& c, const std::vector<Reaction>& reactions);

 private:
  Assembler& assembler_;
  std::vector<int> nodes_;
  std::vector<int> parts_;     ///< of this rank, that touch a supported node
  std::vector<int> grounded_;  ///< of this rank, that stand on node 0
  std::vector<int> place_;     ///< of a node in nodes_, or -1
};

}  // namespace engrane::observe
