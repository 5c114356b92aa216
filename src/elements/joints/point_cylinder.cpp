// SPDX-License-Identifier: BSD-3-Clause
#include "elements/joints/point_cylinder.hpp"

#include <fmt/format.h>

#include "elements/common/building.hpp"

namespace engrane::elements::joints {

namespace {

const FrictionWords point_cylinder_friction{"", "", "", false, false};

std::unique_ptr<Element> build_point_cylinder(const JointData& data, BuildContext& context) {
  auto parts = start_joint(data, context, "joint", PointRule::at_b);
  if (!parts) return nullptr;
  JointFrame& frame = parts->frame;
  const Vec3 at_a = context.nodes.at(data.nodes[0]), on = data.on ? to_vector(*data.on) : at_a;
  const Vec3 reach = parts->point - on, out = reach - frame.e1 * reach.dot(frame.e1);
  if (out.norm() <= 1e-9 * (reach.norm() + on.norm())) {
    context.error(data.on ? "ON" : "N", "the point is on the axis of the cylinder",
                  "ON x y z is a point of the axis, AT x y z the point on the surface");
    return nullptr;
  }
  // joint point A is on the axis, level with the point of B, so that slide and angle start at 0
  frame.arm_a = on + frame.e1 * reach.dot(frame.e1) - at_a;
  frame.set_axes(frame.e1, out.normalized());
  release_rotations(*parts, true);
  parts->normal_channel = "NORMAL_FORCE";
  const double radius = data.radius > 0 ? data.radius : out.norm();
  parts->constraints = {{Measure::radius, radius}};
  if (!add_slide(data, context, *parts) ||
      !add_free(context, *parts, data.turn(), words::turn, Measure::azimuth, CoordinateNames::of("ANGLE", "SPEED")) ||
      !add_friction(data, context, *parts, Rubbing::drum, point_cylinder_friction))
    return nullptr;
  for (JointFriction& f : parts->friction) {
    f.turn = Measure::azimuth;
    f.radius = radius;
  }
  return std::make_unique<Joint>(context.record.id, std::move(*parts));
}

}  // namespace

ElementType point_cylinder_type() {
  JointCard card("POINT_CYLINDER", {"POINT_CYLINDRE"}, "Point on cylinder: a point of node b stays on a cylinder held by node a");
  card.numbered()
      .chapter("Rigid kinematic joints")
      .describe(
          "The axis goes through ON along AXIS; without ON through node a. The point is AT in the reference configuration, "
          "without it node b (node a if b is the ground). The radius is the distance of the point from the axis there unless "
          "RADIUS says otherwise; the slide along the axis and the angle about it are 0 there. The point is held from both "
          "sides. Where it is at node b the joint does not ask for its rotation.")
      .example("I 3 POINT_CYLINDER N 0 2  AXIS 0 0 1  ON 0.5 0 0")
      .example("I 4 POINT_CYLINDER N 1 2  AXIS 0 0 1  FRICTION CONST 0.2 VREG 1D-4");
  add_joint_nodes(card);
  add_joint_axis(card);
  add_joint_point(card);
  card.add("ON", &JointData::on, "a point of the axis, in the reference configuration; default: node a").unit(dimension::length);
  card.add("RADIUS", &JointData::radius, "radius of the cylinder; default: the distance of the point from the axis")
      .synonyms({"RAYON"})
      .unit(dimension::length)
      .at_least(0);
  add_coordinate<0>(card, words::slide);
  add_coordinate<2>(card, words::turn);
  add_joint_friction(card, point_cylinder_friction);
  return element_type(card, build_point_cylinder);
}

}  // namespace engrane::elements::joints
