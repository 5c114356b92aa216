// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "model/registry.hpp"

namespace engrane::elements::bodies {

/// Card of a rigid body. `RIGID N master slave … [M m] [J 1|3|6 values] [CG x y z] [AXES first side] [ABOUT x y z]`. With
/// several values of M, the keywords J, CG, AXES and ABOUT list as many parts, which are combined into one body.
struct RigidBodyData {
  std::vector<int> nodes;  ///< the master first
  std::vector<double> mass;
  std::vector<double> tensor;       ///< about the centre of mass or `about`, in global axes or `axes`
  std::vector<double> centers;      ///< centres of mass, reference configuration; default: the master node
  std::vector<double> axes, about;  ///< first axis of the tensor and side of its second; reference point of the tensor
};

/// RIGID (RIGIDE): nodes that move as one rigid body, with its mass and inertia tensor.
ElementType rigid_body_type();

}  // namespace engrane::elements::bodies
