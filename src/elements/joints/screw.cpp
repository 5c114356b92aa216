// SPDX-License-Identifier: BSD-3-Clause
#include "elements/joints/screw.hpp"

#include <cmath>
#include <numbers>

#include "elements/common/building.hpp"

namespace engrane::elements::joints {

namespace {

const FrictionWords screw_friction{
    "mean radius of the thread", "",
    "distance of the two ends of the nut that carry bending moments; 0: bending moments cause no friction", true, true};

std::unique_ptr<Element> build_screw(const JointData& data, BuildContext& context) {
  auto parts = start_joint(data, context, "screw", PointRule::on_axis);
  if (!parts) return nullptr;
  if (data.slide().drive.given() && data.turn().drive.given()) {
    context.error("TURN", "DRIVE and TURN on one screw", "a screw has one freedom: drive its slide or its turn");
    return nullptr;
  }
  parts->frame.lead = data.pitch / (2 * std::numbers::pi);
  parts->is_bearing = true;
  parts->constraints = {{Measure::gap_2}, {Measure::gap_3}, {Measure::tilt_2}, {Measure::tilt_3}, {Measure::screw}};
  if (!add_slide(data, context, *parts) || !add_turn(data, context, *parts) ||
      !add_friction(data, context, *parts, Rubbing::thread, screw_friction))
    return nullptr;
  for (JointFriction& f : parts->friction) {
    // normal to a flank inclined by α in the axial plane, on a helix of lead angle λ: tan α_n = tan α cos λ
    const double lead = std::atan(parts->frame.lead / f.radius),
                 normal = std::atan(std::tan(data.flank * degree) * std::cos(lead));
    f.steep = 1 / (std::cos(lead) * std::cos(normal));
  }
  return std::make_unique<Joint>(context.record.id, std::move(*parts));
}

}  // namespace

ElementType screw_type() {
  JointCard card("SCREW", {"VIS"}, "Screw joint: node b turns about an axis held by node a and advances by a pitch per turn");
  card.numbered()
      .chapter("Rigid kinematic joints")
      .describe(
          "A cylindrical joint whose slide is PITCH times the turns: a positive pitch is a right-hand thread, b moves along the "
          "axis as it turns about it by the right hand. One of slide and angle may be driven.")
      .example("I 3 SCREW N 0 2  AXIS 0 0 1  PITCH 0.005  TURN SPEED NFT 1");
  add_joint_nodes(card);
  add_joint_axis(card);
  add_joint_point(card);
  card.add("PITCH", &JointData::pitch, "advance per turn; negative is a left-hand thread")
      .synonyms({"PAS"})
      .unit(dimension::length)
      .required();
  add_coordinate<0>(card, words::slide);
  add_coordinate<2>(card, words::turn);
  add_joint_friction(card, screw_friction);
  return element_type(card, build_screw);
}

}  // namespace engrane::elements::joints
