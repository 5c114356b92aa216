// SPDX-License-Identifier: BSD-3-Clause
// Properties of mesh cells, apart from `.MAI` itself.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace engrane::deck {

/// `.HYP MEMB BIDIM GROUP "plate"`: formulation of cells.
struct HypothesisCard {
  std::string formulation, variant;  ///< `MEMB`, `BIDIM`, as written
  std::vector<std::string> groups;   ///< of cells, by name or number; empty: all cells
  double tension = 0;                ///< this and the following members: membranes in space only
  bool wrinkling = false;
  std::optional<double> slack;  ///< fraction of the stiffness that remains when wrinkled; none: the default
};

/// `.PHP GROUP "plate" THICK VAL t`: physical properties of cells.
struct PropertyCard {
  std::vector<std::string> groups;
  std::optional<double> thickness;
};

/// `.AEL I a J b K s MAT m`, `.AEL I n THETA angle`, `.AEL GROUP "frame" MAT 1 BPR 2 AXIS2 0 0 1`: material, axes and section
/// of cells.
struct AssignmentCard {
  std::vector<int> cells;
  std::vector<std::string> groups;
  std::optional<int> material;
  std::optional<double> theta;                  ///< degrees, from the x axis of the frame to the first axis of the material
  std::optional<int> frame;                     ///< `.FRAME` that defines the axes; none: the global frame
  std::optional<int> profile;                   ///< `.BPR` of beams
  std::optional<std::array<double, 3>> axis_2;  ///< beams: a direction across them, on the side of axis 2 of their sections
};

/// `.CLM GROUP "disc" ROT VAL omega AXE x y z [AT px py pz] [NF f]`: centrifugal load.
struct RotationCard {
  std::vector<std::string> groups;        ///< of cells
  double speed = 0;                       ///< radians per unit of time
  std::array<double, 3> axis{}, point{};  ///< direction of any length, and a point on the axis
  int function = 0;                       ///< of time, a factor on the speed; 0: none
};

}  // namespace engrane::deck
