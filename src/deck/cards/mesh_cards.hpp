// SPDX-License-Identifier: BSD-3-Clause
// What a deck says of the cells of a mesh beside `.MAI` itself.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace engrane::deck {

/// `.HYP MEMB BIDIM GROUP "plate"`: which formulation cells get.
struct HypothesisCard {
  std::string formulation, variant;  ///< `MEMB`, `BIDIM`, as written
  std::vector<std::string> groups;   ///< of cells, by name or number; none: all cells
  double tension = 0;                ///< the rest is of membranes in space
  bool wrinkling = false;
  std::optional<double> slack;  ///< part of the stiffness that is left where they wrinkle; none: the usual
};

/// `.PHP GROUP "plate" THICK VAL t`: physical properties of cells.
struct PropertyCard {
  std::vector<std::string> groups;
  std::optional<double> thickness;
};

/// `.AEL I a J b K s MAT m`, `.AEL I n THETA angle`, `.AEL GROUP "frame" MAT 1 BPR 2 AXIS2 0 0 1`: what cells are made of.
struct AssignmentCard {
  std::vector<int> cells;
  std::vector<std::string> groups;
  std::optional<int> material;
  std::optional<double> theta;                  ///< degrees, from the x axis of the frame to the first axis of the material
  std::optional<int> frame;                     ///< `.FRAME` of the axes; none: the global one
  std::optional<int> profile;                   ///< `.BPR` of beams
  std::optional<std::array<double, 3>> axis_2;  ///< across beams, on the side of axis 2 of their sections
};

/// `.CLM GROUP "disc" ROT VAL omega AXE x y z [AT px py pz] [NF f]`: centrifugal load.
struct RotationCard {
  std::vector<std::string> groups;        ///< of cells
  double speed = 0;                       ///< radians per unit of time
  std::array<double, 3> axis{}, point{};  ///< of any length; a point on it
  int function = 0;                       ///< of time, a factor of the speed; 0: none
};

}  // namespace engrane::deck
