// SPDX-License-Identifier: BSD-3-Clause
#include "elements/common/line.hpp"

#include <fmt/format.h>

namespace engrane::elements {

std::optional<LineEnds> LineEnds::of(const BuildContext& context, const std::array<int, 2>& nodes,
                                     const std::optional<std::array<double, 3>>& at, std::string_view cure) {
  LineEnds ends{nodes};
  if (at) {
    if (nodes[0] != 0 && nodes[1] != 0) {
      context.error("AT", "AT is where the ground's end is, and neither node is the ground", "leave AT out, or N 0 b");
      return {};
    }
    ends.anchor[nodes[0] == 0 ? 0 : 1] = to_vector(*at);
  }
  const Vec3 first = context.nodes.at(nodes[0]) + ends.anchor[0], last = context.nodes.at(nodes[1]) + ends.anchor[1];
  if (first == last) {
    context.error("N", fmt::format("nodes {} and {} are in one place: there is no line between them", nodes[0], nodes[1]),
                  std::string(cure));
    return {};
  }
  return ends;
}

}  // namespace engrane::elements
