// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "model/element.hpp"

namespace engrane {

/// State of the whole mechanism at one instant. Every rank holds all of it.
struct Configuration {
  double time = 0;
  double lead = 0;               ///< functions of time are evaluated at time + lead; zero except along an equilibrium path
  double h = 0;                  ///< length of the step that ends here; 0 if there is none
  std::vector<NodeState> nodes;  ///< in the order of Model::nodes; the first is the ground
  std::vector<double> scalars, scalar_rates, scalar_accelerations;
  /// Rounding remainders of positions, rotations (material components, in radians) and scalars; one entry per motion slot. They
  /// accumulate increments smaller than the rounding error of a position.
  std::vector<double> remainders;
  std::vector<double> multipliers;  ///< kλ: forces and moments
  std::vector<double> history;      ///< of all elements, as last committed

  /// Time at which elements and functions of time are evaluated.
  double load_time() const { return time + lead; }
};

/// Returns `c` with increments of rotations that start anew (T = identity). Elements take tangents with respect to the increment
/// of a step's rotation vector: only here they are those of the motion itself, and symmetric where forces have a potential.
inline Configuration at_start_of_step(Configuration c) {
  for (NodeState& node : c.nodes) node.T.setIdentity();
  return c;
}

}  // namespace engrane
