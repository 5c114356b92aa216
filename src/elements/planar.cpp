// SPDX-License-Identifier: BSD-3-Clause
#include "elements/planar.hpp"

#include "elements/building.hpp"

namespace engrane {

namespace {

std::unique_ptr<Element> build(const JointData& data, BuildContext& context) {
  auto parts = start_joint(data, context, "planar joint", PointRule::at_b);
  if (!parts) return nullptr;
  if (data.second) {
    const auto along = unit_vector(context, "DIR", *data.second);
    if (!along) return nullptr;
    const Vec3 in_plane = *along - parts->frame.e1 * along->dot(parts->frame.e1);
    if (in_plane.norm() < 1e-6) {
      context.error("DIR", "DIR is along the normal AXIS", "give a direction in the plane");
      return nullptr;
    }
    parts->frame.e2 = in_plane.normalized();
    parts->frame.e3 = cross(parts->frame.e1, parts->frame.e2);
  }
  parts->constraints = {{Measure::gap_1}, {Measure::tilt_2}, {Measure::tilt_3}};
  parts->coordinates = {{Measure::gap_2, "SLIDE_2", "SLIDE_2_SPEED", data.stiffness, data.damping},
                        {Measure::gap_3, "SLIDE_3", "SLIDE_3_SPEED", data.stiffness, data.damping}};
  if (!add_turn(data, context, *parts)) return nullptr;
  return std::make_unique<Joint>(context.record.id, std::move(*parts));
}

}  // namespace

ElementType planar_type() {
  JointCard card("PLANAR", {"PLAN"}, "Planar joint: node b slides on a plane held by node a and turns about its normal");
  card.numbered()
      .chapter("Rigid kinematic joints")
      .describe(
          "AXIS is the normal. The slides along DIR and across it, and the angle, are 0 in the reference configuration. K and C "
          "act on both slides. AT is the point whose slides and moments are reported, without it node b.")
      .example("I 3 PLANAR N 0 2  AXIS 0 0 1")
      .example("I 4 PLANAR N 0 2  AXIS 0 0 1  DIR 1 0 0  TURN SPEED NFT 1");
  add_joint_nodes(card);
  card.add("AXIS", &JointData::axis, "normal of the plane, held by a, in the reference configuration")
      .synonyms({"AXE", "NORMAL"})
      .required();
  card.add("DIR", &JointData::second, "direction of the first slide; any by default");
  add_joint_point(card);
  add_turn_drive(card);
  card.add("K", &JointData::stiffness, "spring on both slides").unit(dimension::stiffness).at_least(0);
  card.add("C", &JointData::damping, "damper on both slides").unit(dimension::damping).at_least(0);
  add_turn_spring(card);
  return element_type(card, build);
}

}  // namespace engrane
