// SPDX-License-Identifier: BSD-3-Clause
#include "elements/common/along_motion.hpp"

namespace engrane::elements {

std::array<Motion<Taylor, 2>::Node, 2> along_motion(const State& state) {
  std::array<Motion<Taylor, 2>::Node, 2> node;
  for (std::size_t i = 0; i < 2; ++i) {
    const NodeState& s = state.nodes[i];
    const Mat3 W = skew(s.W), first = s.R * W, twice = s.R * (skew(s.A) + W * W);
    for (int a = 0; a < 3; ++a) {
      node[i].x[a] = {s.x[a], s.v[a], s.a[a]};
      for (int b = 0; b < 3; ++b) node[i].R(a, b) = {s.R(a, b), first(a, b), twice(a, b)};
    }
  }
  return node;
}

}  // namespace engrane::elements
