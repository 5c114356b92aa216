// SPDX-License-Identifier: BSD-3-Clause
#include "elements/joints/point_plane.hpp"

namespace engrane::elements::joints {

namespace {

const FrictionWords point_plane_friction{"", "", "", false, false};

std::unique_ptr<Element> build_point_plane(const JointData& data, BuildContext& context) {
  auto parts = start_joint(data, context, "joint", PointRule::at_b);
  if (!parts) return nullptr;
  release_rotations(*parts, true);
  parts->constraints = {{Measure::gap_1}};
  if (!find_plane_axes(data, context, *parts) || !add_slides(data, context, *parts) ||
      !add_friction(data, context, *parts, Rubbing::face, point_plane_friction))
    return nullptr;
  return std::make_unique<Joint>(context.record.id, std::move(*parts));
}

}  // namespace

ElementType point_plane_type() {
  JointCard card("POINT_PLANE", {"POINT_PLAN"}, "Point on plane: a point of node b stays on a plane held by node a");
  card.numbered()
      .chapter("Rigid kinematic joints")
      .describe(
          "The point is AT in the reference configuration, without it node b (node a if b is the ground), and the plane goes "
          "through it with the normal AXIS. Where the point is at node b the joint does not ask for its rotation.")
      .example("I 3 POINT_PLANE N 0 2  AXIS 0 0 1");
  add_joint_nodes(card);
  card.add("AXIS", &JointData::axis, "normal of the plane, held by a, in the reference configuration")
      .synonyms({"AXE", "NORMAL"})
      .required();
  add_joint_point(card);
  add_plane_slides(card);
  add_joint_friction(card, point_plane_friction);
  return element_type(card, build_point_plane);
}

}  // namespace engrane::elements::joints
