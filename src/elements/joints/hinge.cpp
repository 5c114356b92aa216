// SPDX-License-Identifier: BSD-3-Clause
#include "elements/joints/hinge.hpp"

namespace engrane::elements::joints {

namespace {

const FrictionWords hinge_friction{"radius of the pin", "friction radius of the thrust collar; 0: no collar friction",
                                   "distance of the two bushes that carry bending moments; 0: bending moments cause no friction",
                                   false, true};

std::unique_ptr<Element> build_hinge(const JointData& data, BuildContext& context) {
  auto parts = start_joint(data, context, "hinge", PointRule::one_place);
  if (!parts) return nullptr;
  parts->is_bearing = parts->has_axial = true;
  parts->constraints = {{Measure::gap_1}, {Measure::gap_2}, {Measure::gap_3}, {Measure::tilt_2}, {Measure::tilt_3}};
  const CoordinateNames names{"ANGLE", "SPEED", "SPRING_TORQUE", "DRIVE_TORQUE", "DRIVE_POWER", "STOP_TORQUE", "STOP_GAP"};
  if (!add_free(context, *parts, data.turn(), words::angle, Measure::angle, names) ||
      !add_friction(data, context, *parts, Rubbing::journal, hinge_friction))
    return nullptr;
  return std::make_unique<Joint>(context.record.id, std::move(*parts));
}

}  // namespace

ElementType hinge_type() {
  JointCard card("HINGE", {"CHARNIERE"}, "Revolute joint: node b turns about an axis held by node a");
  card.numbered()
      .chapter("Rigid kinematic joints")
      .describe(
          "The joint point is held by both nodes, each in its own axes, so the nodes may be anywhere: AT gives the point "
          "in the reference configuration. Without it the nodes must be in one place, or one of them is the ground "
          "(0) and the point is where the other is. The angle is counted in turns.")
      .example("I 3 HINGE N 3 2  AXIS 0 0 1")
      .example("I 4 HINGE N 0 4  AXIS 0 1 0  DRIVE SPEED NF 1")
      .example("I 5 HINGE N 0 4  AXIS 0 1 0  FRICTION CONST 0.1 VREG 1D-4 RADIUS 0.01  MIN -30 MAX 45 KSTOP 2D3");
  add_joint_nodes(card);
  add_joint_axis(card);
  add_joint_point(card);
  add_coordinate<2>(card, words::angle);
  add_joint_friction(card, hinge_friction);
  return element_type(card, build_hinge);
}

}  // namespace engrane::elements::joints
