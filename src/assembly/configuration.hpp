// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "model/element.hpp"

namespace engrane {

/// The whole mechanism at one instant: every value that moves, on every rank.
struct Configuration {
  double time = 0;
  double lead = 0;               ///< functions of time stand at time + lead: zero but along a path of equilibria
  double h = 0;                  ///< of the step that ends here; 0 where there is none
  std::vector<NodeState> nodes;  ///< in the order of Model::nodes; the first is the ground
  std::vector<double> scalars, scalar_rates, scalar_accelerations;
  /// What rounding left out of positions, rotations (material, in radians) and scalars; one entry per motion slot. Increments
  /// smaller than the rounding of a position add up here.
  std::vector<double> remainders;
  std::vector<double> multipliers;  ///< kλ: forces and moments
  std::vector<double> history;      ///< of all elements, as last committed

  /// What elements and functions of time take for the time.
  double load_time() const { return time + lead; }
};

}  // namespace engrane
