// SPDX-License-Identifier: BSD-3-Clause
#include "elements/common/held_point.hpp"

#include <fmt/format.h>

namespace engrane::elements {

Drawing HeldPoint::drawing() const {
  return {fmt::format(R"("shape": "axis", "node": {}, "center": {}, "axis": {})", nodes[0] != 0 ? nodes[0] : nodes[1],
                      json(point), json(Vec3(axes.col(0))))};
}

std::optional<Mat3> axes_of(const BuildContext& context, const std::array<double, 3>& axis,
                            const std::optional<std::array<double, 3>>& axis_2) {
  const auto first = unit_vector(context, "AXIS", axis);
  if (!first) return {};
  Vec3 second = perpendicular(*first);
  if (axis_2) {
    const auto side = unit_vector(context, "AXIS2", *axis_2);
    if (!side) return {};
    second = *side - first->dot(*side) * *first;
    if (second.norm() < 1e-6) {
      context.error("AXIS2", "AXIS2 is along AXIS", "give a direction across the first axis");
      return {};
    }
    second.normalize();
  }
  Mat3 axes;
  axes << *first, second, cross(*first, second);
  return axes;
}

}  // namespace engrane::elements
