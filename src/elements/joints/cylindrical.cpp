// SPDX-License-Identifier: BSD-3-Clause
#include "elements/joints/cylindrical.hpp"

namespace engrane::elements::joints {

namespace {

const FrictionWords cylindrical_friction{
    "radius of the shaft; 0: turning causes no friction", "",
    "distance of the two bushes that carry bending moments; 0: bending moments cause no friction", false, false};

std::unique_ptr<Element> build_cylindrical(const JointData& data, BuildContext& context) {
  auto parts = start_joint(data, context, "cylindrical joint", PointRule::on_axis);
  if (!parts) return nullptr;
  parts->is_bearing = true;
  parts->constraints = {{Measure::gap_2}, {Measure::gap_3}, {Measure::tilt_2}, {Measure::tilt_3}};
  if (!add_slide(data, context, *parts) || !add_turn(data, context, *parts) ||
      !add_friction(data, context, *parts, Rubbing::sleeve, cylindrical_friction))
    return nullptr;
  return std::make_unique<Joint>(context.record.id, std::move(*parts));
}

}  // namespace

ElementType cylindrical_type() {
  JointCard card("CYLINDRICAL", {"CYLINDRIQUE", "CYLINDRE"},
                 "Cylindrical joint: node b slides along an axis held by node a and turns about it");
  card.numbered()
      .chapter("Rigid kinematic joints")
      .describe(
          "The axis goes through the joint point AT; without it the nodes must be in one place or apart along the axis, or one "
          "of them is the ground. Slide and angle are 0 in the reference configuration; the angle is counted in turns.")
      .example("I 3 CYLINDRICAL N 1 2  AXIS 0 0 1")
      .example("I 4 CYLINDRICAL N 0 2  AXIS 0 0 1  DRIVE SLIDE NF 1  TURN SPEED NFT 2");
  add_joint_nodes(card);
  add_joint_axis(card);
  add_joint_point(card);
  add_coordinate<0>(card, words::slide);
  add_coordinate<2>(card, words::turn);
  add_joint_friction(card, cylindrical_friction);
  return element_type(card, build_cylindrical);
}

}  // namespace engrane::elements::joints
