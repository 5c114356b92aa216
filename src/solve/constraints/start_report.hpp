// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "assembly/assembler.hpp"

namespace engrane::solve {

/// Report of the start, phase by phase, for the listing.
struct StartReport {
  struct Moved {
    int node = 0;  ///< index into Model::nodes
    double move = 0, turn = 0;
  };
  struct Opened {
    int part = 0;
    double length = 0, angle = 0;  ///< violation of its constraints before the assembly
  };

  /// Assembly of positions.
  int position_iterations = 0;
  int path_steps = 0;                    ///< steps taken to close the gaps gradually; 0 if not needed
  std::vector<Moved> moved;              ///< nodes that moved or turned, the farthest first
  std::vector<Opened> opened;            ///< joints that did not fit, the largest gap first
  std::vector<std::string> coordinates;  ///< joint values set by the deck: "ANGLE of HINGE 2 = 30 deg"
  std::vector<std::string> carried;      ///< elastic bodies that move as wholes: "that of node 1 (63 nodes)"
  std::vector<std::string> remarks;      ///< on the branch that was reached, and on bodies that begin torn
  double largest_move = 0;               ///< in the deck's unit of length
  double largest_turn = 0;               ///< radians

  /// Velocities.
  bool velocities_fitted = false;
  double largest_velocity_change = 0;  ///< from the given initial velocities, per unit of time
  std::string velocity_changed_most;   ///< "node 3 (x)"
  std::string rate_violated_most;      ///< constraint most violated by the given velocities; empty if none

  /// Accelerations and multipliers.
  bool accelerations_found = false;
  int acceleration_iterations = 0;
  double largest_acceleration = 0;  ///< of a translation or, when nothing else moves, of a rotation
  std::string accelerated_most;     ///< "node 3 (x)"
  double largest_force = 0;         ///< multiplier that is a force, or a moment when there are no forces
  std::string carried_most;         ///< "HINGE 3 (FORCE_1)"
  bool softened = false;            ///< some parts are stiffer than steps resolve (Start::soften)

  int massless = 0;              ///< motions without mass, in equilibrium with springs and dampers
  std::string massless_example;  ///< "node 2 (x)"

  int redundant = 0;     ///< constraints that follow from others
  std::string friction;  ///< elements whose friction depends on reactions that are not unique (friction_on_redundant())
  std::string mobility;  ///< degrees of freedom and redundant constraints, as a paragraph
};

/// Name of a node's motion slot: "node 3 (x)".
std::string slot_name(const Model& model, std::size_t slot);

/// The paragraphs of the listing and of `engrane check`.
std::string describe_start(const Model& model, const StartReport& report);

}  // namespace engrane::solve
