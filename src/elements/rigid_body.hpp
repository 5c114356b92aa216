// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "model/registry.hpp"

namespace engrane {

/// Card of a rigid body. `RIGID N master slave … [M m] [J 1|3|6 values] [CG x y z]`
struct RigidBodyData {
  std::vector<int> nodes;  ///< the master first
  double mass = 0;
  std::vector<double> tensor;                   ///< about the centre of mass, global axes of the reference configuration
  std::optional<std::array<double, 3>> center;  ///< centre of mass, reference configuration; default: the master node
};

/// RIGID (RIGIDE): nodes that move as one body, with its mass and inertia tensor.
ElementType rigid_body_type();

}  // namespace engrane
