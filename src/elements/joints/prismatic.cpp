// SPDX-License-Identifier: BSD-3-Clause
#include "elements/joints/prismatic.hpp"

namespace engrane::elements::joints {

namespace {

const FrictionWords prismatic_friction{
    "lever at which a key or two rails hold the slider from turning; default: their friction is left out", "",
    "distance of the two shoes that carry bending moments; 0: bending moments cause no friction", false, false};

std::unique_ptr<Element> build_prismatic(const JointData& data, BuildContext& context) {
  auto parts = start_joint(data, context, "prismatic joint", PointRule::at_b);
  if (!parts) return nullptr;
  parts->is_bearing = true;
  parts->constraints = {{Measure::gap_2}, {Measure::gap_3}, {Measure::turn_1}, {Measure::turn_2}, {Measure::turn_3}};
  if (!add_slide(data, context, *parts) || !add_friction(data, context, *parts, Rubbing::guide, prismatic_friction))
    return nullptr;
  return std::make_unique<Joint>(context.record.id, std::move(*parts));
}

}  // namespace

ElementType prismatic_type() {
  JointCard card("PRISMATIC", {"PRISMATIQUE", "SLIDER", "GLISSIERE"},
                 "Prismatic joint: node b slides along an axis held by node a");
  card.numbered()
      .chapter("Rigid kinematic joints")
      .describe(
          "Node b slides along the axis and does not turn from node a. The slide is 0 in the reference configuration. The nodes "
          "may be anywhere; AT is the point at which moments are reported, without it node b.")
      .example("I 3 PRISMATIC N 0 2  AXIS 1 0 0  K 1000 SLIDE0 0.1")
      .example("I 4 PRISMATIC N 1 2  AXIS 0 0 1  DRIVE SPEED NF 1");
  add_joint_nodes(card);
  add_joint_axis(card);
  add_joint_point(card);
  add_coordinate<0>(card, words::slide);
  add_joint_friction(card, prismatic_friction);
  return element_type(card, build_prismatic);
}

}  // namespace engrane::elements::joints
