// SPDX-License-Identifier: BSD-3-Clause
#include "elements/joints/planar.hpp"

namespace engrane::elements::joints {

namespace {

const FrictionWords planar_friction{"friction radius of the face about its normal; 0: spinning causes no friction", "", "", false,
                                    false};

std::unique_ptr<Element> build_planar(const JointData& data, BuildContext& context) {
  auto parts = start_joint(data, context, "planar joint", PointRule::at_b);
  if (!parts) return nullptr;
  if (!find_plane_axes(data, context, *parts)) return nullptr;
  parts->constraints = {{Measure::gap_1}, {Measure::tilt_2}, {Measure::tilt_3}};
  if (!add_slides(data, context, *parts) || !add_turn(data, context, *parts) ||
      !add_friction(data, context, *parts, Rubbing::face, planar_friction))
    return nullptr;
  return std::make_unique<Joint>(context.record.id, std::move(*parts));
}

}  // namespace

ElementType planar_type() {
  JointCard card("PLANAR", {"PLAN"}, "Planar joint: node b slides on a plane held by node a and turns about its normal");
  card.numbered()
      .chapter("Rigid kinematic joints")
      .describe(
          "AXIS is the normal. The slides along DIR and across it, and the angle, are 0 in the reference configuration. K and C "
          "act on both slides, keywords that end in 2 and 3 on one of them, those that end in T on the angle. AT is the point "
          "whose slides and moments are reported, without it node b.")
      .example("I 3 PLANAR N 0 2  AXIS 0 0 1")
      .example("I 4 PLANAR N 0 2  AXIS 0 0 1  DIR 1 0 0  TURN SPEED NFT 1");
  add_joint_nodes(card);
  card.add("AXIS", &JointData::axis, "normal of the plane, held by a, in the reference configuration")
      .synonyms({"AXE", "NORMAL"})
      .required();
  add_joint_point(card);
  add_plane_slides(card);
  add_coordinate<2>(card, words::turn);
  add_joint_friction(card, planar_friction);
  return element_type(card, build_planar);
}

}  // namespace engrane::elements::joints
