// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "model/registry.hpp"

namespace engrane::elements::beams {

/// Card of a beam. `BEAM N n1 n2 … BPR p [BPR_END q] [MAT m] [AXIS2 x y z] [AXIS2_END x y z] [DAMPING t] [LINEAR]
/// [INEXTENSIBLE] [UNSHEARABLE] [RELEASE_A c …] [RELEASE_B c …]`
struct BeamData {
  std::vector<int> nodes;  ///< ordered along the beam
  int profile = 0;
  int profile_end = 0;                              ///< at the last node; 0: same as `profile`
  int material = 0;                                 ///< 0: the profile gives stiffness and mass
  std::optional<std::array<double, 3>> axis_2;      ///< direction across the beam, on the side of section axis 2
  std::optional<std::array<double, 3>> axis_2_end;  ///< the same at the last node of a twisted beam
  std::optional<double> damping;                    ///< Kelvin–Voigt damping time; none: that of the material
  bool linear = false;                              ///< pieces of two nodes
  bool inextensible = false, unshearable = false;
  std::vector<int> release_a, release_b;  ///< components 1 to 6 released at the first and last end
};

/// BEAM (POUTRE): a flexible line of nodes.
ElementType beam_type();

}  // namespace engrane::elements::beams
