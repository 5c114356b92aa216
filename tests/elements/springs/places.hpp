// SPDX-License-Identifier: BSD-3-Clause
// What the tests of springs share.
#pragma once

#include <array>

#include "elements/suite.hpp"

namespace engrane::elements::springs {

/// The ground and two nodes.
inline const suite::NodeMap places = {{0, Vec3::Zero()}, {1, {1, 0.2, -0.3}}, {2, {-0.5, 0.4, 0.8}}};

inline std::array<double, 3> list(const Vec3& v) { return {v[0], v[1], v[2]}; }

}  // namespace engrane::elements::springs
