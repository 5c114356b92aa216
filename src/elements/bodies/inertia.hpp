// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "model/registry.hpp"

namespace engrane::elements::bodies {

/// Card of a point inertia. `INERTIA N n [M m] [J 1|3|6 values] [OFFSET x y z] [AXES first side] [ABOUT x y z]
/// [OUTER d WIDTH w [INNER d] [AXIS x y z]]`
struct InertiaData {
  int node = 0;
  double mass = 0;
  std::vector<double> tensor;                 ///< about the centre of mass or `about`, in global axes or `axes`
  std::array<double, 3> offset{0, 0, 0};      ///< from the node to the centre of mass, reference configuration
  std::vector<double> axes, about;            ///< first axis of the tensor, side of its second; reference point of the tensor
  std::optional<double> outer, width, inner;  ///< the disc shown in drawings: diameters and width
  std::optional<std::array<double, 3>> axis;  ///< of the disc; default: the first axis of the tensor
};

/// INERTIA (INERTIE): mass and inertia tensor on a node.
ElementType inertia_type();

}  // namespace engrane::elements::bodies
