// SPDX-License-Identifier: BSD-3-Clause
#include "elements/joints/spherical.hpp"

namespace engrane::elements::joints {

namespace {

const FrictionWords spherical_friction{"radius of the ball"};

std::unique_ptr<Element> build_spherical(const JointData& data, BuildContext& context) {
  auto parts = start_joint(data, context, "spherical joint", PointRule::one_place, false);
  if (!parts) return nullptr;
  if (!data.friction.given()) release_rotations(*parts, false);
  parts->constraints = {{Measure::gap_1}, {Measure::gap_2}, {Measure::gap_3}};
  if (!add_friction(data, context, *parts, Rubbing::ball, spherical_friction)) return nullptr;
  return std::make_unique<Joint>(context.record.id, std::move(*parts));
}

}  // namespace

ElementType spherical_type() {
  JointCard card("SPHERICAL", {"ROTULE", "BALL"},
                 "Spherical joint: nodes a and b have a point in common and turn freely about it");
  card.numbered()
      .chapter("Rigid kinematic joints")
      .describe(
          "The joint point is held by both nodes. AT gives it in the reference configuration; without it the nodes must be in "
          "one place, or one of them is the ground. Where the point is at a node the joint does not ask for its rotation.")
      .example("I 3 SPHERICAL N 1 2")
      .example("I 4 SPHERICAL N 0 2  AT 0 0 1.5");
  add_joint_nodes(card);
  add_joint_point(card);
  add_joint_friction(card, spherical_friction);
  return element_type(card, build_spherical);
}

}  // namespace engrane::elements::joints
