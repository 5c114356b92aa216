// SPDX-License-Identifier: BSD-3-Clause
#include "elements/common/along_motion.hpp"

namespace engrane::elements {

Motion<Taylor, 2>::Node along_motion(const NodeState& s) {
  Motion<Taylor, 2>::Node node;
  const Mat3 W = skew(s.W), first = s.R * W, twice = s.R * (skew(s.A) + W * W);
  for (int a = 0; a < 3; ++a) {
    node.x[a] = {s.x[a], s.v[a], s.a[a]};
    for (int b = 0; b < 3; ++b) node.R(a, b) = {s.R(a, b), first(a, b), twice(a, b)};
  }
  return node;
}

std::array<Motion<Taylor, 2>::Node, 2> along_motion(const State& state) {
  return {along_motion(state.nodes[0]), along_motion(state.nodes[1])};
}

}  // namespace engrane::elements
