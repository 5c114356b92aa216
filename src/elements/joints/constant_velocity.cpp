// SPDX-License-Identifier: BSD-3-Clause
#include "elements/joints/constant_velocity.hpp"

#include <fmt/format.h>

#include <cmath>

#include "elements/common/building.hpp"

namespace engrane::elements::joints {

namespace {

constexpr double largest_bend = 175;  // degrees: at 180 the axis of the bend is undefined

std::unique_ptr<Element> build_constant_velocity(const JointData& data, BuildContext& context) {
  auto parts = start_joint(data, context, "constant velocity joint", PointRule::one_place);
  if (!parts) return nullptr;
  JointFrame& frame = parts->frame;
  if (data.second) {
    const auto shaft = unit_vector(context, "AXIS2", *data.second);
    if (!shaft) return nullptr;
    const Vec3 across = cross(frame.e1, *shaft);
    const double bend = std::atan2(across.norm(), frame.e1.dot(*shaft)) / degree;
    if (bend > largest_bend) {
      context.error("AXIS2", fmt::format("the shafts are bent by {:.6g} degrees", bend),
                    "both point the same way along the drive line: AXIS towards the joint, AXIS2 away from it");
      return nullptr;
    }
    // B's axes are A's, rotated by the bend and not about the shaft: v + w×v + w×(w×v)/(1 + cos)
    const double cosine = frame.e1.dot(*shaft);
    const auto bent = [&](const Vec3& v) {
      const Vec3 once = cross(across, v);
      return Vec3(v + once + cross(across, once) / (1 + cosine));
    };
    frame.b1 = *shaft;
    frame.b2 = bent(frame.e2);
    frame.b3 = bent(frame.e3);
  }
  parts->has_bend = true;
  parts->normal_channel = "TORQUE";
  parts->constraints = {{Measure::twist}, {Measure::gap_1}, {Measure::gap_2}, {Measure::gap_3}};
  return std::make_unique<Joint>(context.record.id, std::move(*parts));
}

}  // namespace

ElementType constant_velocity_type() {
  JointCard card("CONSTANT_VELOCITY", {"HOMOCINETIQUE", "CV_JOINT"},
                 "Constant velocity joint: two shafts that meet in a point turn by the same angle, however they are bent");
  card.numbered()
      .chapter("Rigid kinematic joints")
      .describe(
          "AXIS is the direction of a's shaft, AXIS2 that of b's, both along the drive line; without AXIS2 the shafts are in "
          "line in the reference configuration. They meet in the joint point AT; without it the nodes must be in one place, or "
          "one of them is the ground.")
      .example("I 3 CONSTANT_VELOCITY N 1 2  AXIS 1 0 0  AT 0.3 0 0")
      .example("I 4 CONSTANT_VELOCITY N 1 2  AXIS 1 0 0  AXIS2 1 0 -1  AT 0.3 0 0");
  add_joint_nodes(card);
  card.add("AXIS", &JointData::axis, "direction of a's shaft, in the reference configuration").synonyms({"AXE"}).required();
  card.add("AXIS2", &JointData::second, "direction of b's shaft; default: that of a's").synonyms({"AXE2"});
  add_joint_point(card);
  return element_type(card, build_constant_velocity);
}

}  // namespace engrane::elements::joints
