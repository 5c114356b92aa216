// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "elements/common/spring_law.hpp"

namespace engrane::elements::springs {

/// Card of a torsion spring. `TSPRING N a b AXIS x y z [K k | LAW TABLE f | LAW POLY k1 k2 k3 | LAW USER f] [C c | CLAW f]
/// [ANGLE0 deg]`
struct TorsionSpringData : SpringLawData {
  std::array<int, 2> nodes{};
  std::array<double, 3> axis{};
  double stiffness = 0;  ///< per radian
  double damping = 0;
  double angle0 = 0;  ///< angle of the relaxed spring, degrees
};

/// TSPRING (RESSORT_TORSION): spring and damper on the rotation of node B relative to A about an axis fixed to A.
ElementType torsion_spring_type();

}  // namespace engrane::elements::springs
