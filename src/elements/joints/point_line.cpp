// SPDX-License-Identifier: BSD-3-Clause
#include "elements/joints/point_line.hpp"

namespace engrane::elements::joints {

namespace {

const FrictionWords point_line_friction{"", "", "", false, false};

std::unique_ptr<Element> build_point_line(const JointData& data, BuildContext& context) {
  auto parts = start_joint(data, context, "joint", PointRule::at_b);
  if (!parts) return nullptr;
  release_rotations(*parts, true);
  parts->is_bearing = true;
  parts->constraints = {{Measure::gap_2}, {Measure::gap_3}};
  if (!add_slide(data, context, *parts) || !add_friction(data, context, *parts, Rubbing::guide, point_line_friction))
    return nullptr;
  return std::make_unique<Joint>(context.record.id, std::move(*parts));
}

}  // namespace

ElementType point_line_type() {
  JointCard card("POINT_LINE", {"POINT_DROITE"}, "Point on line: a point of node b stays on a line held by node a");
  card.numbered()
      .chapter("Rigid kinematic joints")
      .describe(
          "The point is AT in the reference configuration, without it node b (node a if b is the ground), and the line goes "
          "through it along AXIS. The slide is 0 there. Where the point is at node b the joint does not ask for its rotation.")
      .example("I 3 POINT_LINE N 0 2  AXIS 1 0 0");
  add_joint_nodes(card);
  add_joint_axis(card);
  add_joint_point(card);
  add_coordinate<0>(card, words::slide);
  add_joint_friction(card, point_line_friction);
  return element_type(card, build_point_line);
}

}  // namespace engrane::elements::joints
