// SPDX-License-Identifier: BSD-3-Clause
#include "elements/joints/universal.hpp"

#include <fmt/format.h>

#include "elements/common/building.hpp"

namespace engrane::elements::joints {

namespace {

const FrictionWords universal_friction{"radius of the pins", "friction radius of the ends of the pins; 0: these have no friction",
                                       "distance of the two bearings of either pin; default: the torque presses nothing", false,
                                       true};

std::unique_ptr<Element> build_universal(const JointData& data, BuildContext& context) {
  auto parts = start_joint(data, context, "universal joint", PointRule::one_place);
  if (!parts) return nullptr;
  const auto pin_b = unit_vector(context, "AXIS2", *data.second);
  if (!pin_b) return nullptr;
  const double together = parts->frame.e1.dot(*pin_b);
  if (std::abs(together) > 1e-6) {
    const Vec3 right = *pin_b - parts->frame.e1 * together;
    context.error("AXIS2", fmt::format("the pins are at {:.6g} degrees", std::acos(together) / degree),
                  right.norm() < 1e-6 ? "they must be perpendicular"
                                      : fmt::format("they must be perpendicular; nearest: AXIS2 {} {} {}", number(right[0]),
                                                    number(right[1]), number(right[2])));
    return nullptr;
  }
  parts->frame.set_axes(parts->frame.e1, (*pin_b - parts->frame.e1 * together).normalized());
  parts->constraints = {{Measure::gap_1}, {Measure::gap_2}, {Measure::gap_3}, {Measure::pins}};
  const auto first = with_both(context, data, data.turn(), words::pin_1, "T");
  const auto second = with_both(context, data, data.turn_b(), words::pin_2, "T");
  if (!first || !second ||
      !add_free(context, *parts, *first, words::pin_1, Measure::pin_a, CoordinateNames::of("ANGLE_1", "SPEED_1")) ||
      !add_free(context, *parts, *second, words::pin_2, Measure::pin_b, CoordinateNames::of("ANGLE_2", "SPEED_2")) ||
      !add_friction(data, context, *parts, Rubbing::journal, universal_friction))
    return nullptr;
  if (!parts->friction.empty()) {  // both pins have the same friction data
    JointFriction& a = parts->friction.front();
    a.turn = Measure::pin_a;
    a.suffix = "_1";
    JointFriction b = a;
    b.turn = Measure::pin_b;
    b.suffix = "_2";
    parts->friction.push_back(b);
  }
  return std::make_unique<Joint>(context.record.id, std::move(*parts));
}

}  // namespace

ElementType universal_type() {
  JointCard card("UNIVERSAL", {"CARDAN"}, "Universal joint: two shafts joined by a cross of perpendicular pins");
  card.numbered()
      .chapter("Rigid kinematic joints")
      .describe(
          "AXIS is the pin held by node a, AXIS2 the pin held by node b, perpendicular to it. They meet in the joint point AT; "
          "without it the nodes must be in one place, or one of them is the ground. KT, CT and ANGLE0 act on both pins, keywords "
          "that end in 1 on that of a, in 2 on that of b.")
      .example("I 3 UNIVERSAL N 1 2  AXIS 0 1 0  AXIS2 0 0 1  AT 0.3 0 0");
  add_joint_nodes(card);
  card.add("AXIS", &JointData::axis, "pin held by a, in the reference configuration").synonyms({"AXE"}).required();
  card.add("AXIS2", &JointData::second, "pin held by b").synonyms({"AXE2"}).required();
  add_joint_point(card);
  card.add("KT", &JointData::both_stiffness, "torsion spring on either pin, moment per radian")
      .unit(dimension::torsional_stiffness)
      .at_least(0);
  card.add("CT", &JointData::both_damping, "torsion damper on either pin, moment per radian and time")
      .unit(dimension::torsional_damping)
      .at_least(0);
  card.add("ANGLE0", &JointData::both_relaxed, "angle of either pin at which its spring is relaxed").unit(dimension::angle);
  add_coordinate<2>(card, words::pin_1);
  add_coordinate<3>(card, words::pin_2);
  add_joint_friction(card, universal_friction);
  return element_type(card, build_universal);
}

}  // namespace engrane::elements::joints
