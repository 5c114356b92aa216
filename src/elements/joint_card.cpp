// SPDX-License-Identifier: BSD-3-Clause
#include "elements/joint_card.hpp"

#include <fmt/format.h>

#include "elements/building.hpp"

namespace engrane {

std::optional<Vec3> joint_point(const BuildContext& context, const std::array<int, 2>& nodes,
                                const std::optional<std::array<double, 3>>& at, const std::string& joint, PointRule rule,
                                const Vec3& axis) {
  if (at) return to_vector(*at);
  const auto [a, b] = nodes;
  const Vec3 &at_a = context.nodes.at(a), &at_b = context.nodes.at(b);
  if (a == 0) return at_b;
  if (b == 0 || same_place(at_a, at_b)) return at_a;
  if (rule == PointRule::at_b) return at_b;
  const Vec3 apart = at_b - at_a;
  if (rule == PointRule::on_axis && cross(axis, apart).norm() <= 1e-6 * apart.norm()) return at_b;
  context.error("N",
                fmt::format("nodes {} and {} of the {} are {:.6g} apart{}", a, b, joint, apart.norm(),
                            rule == PointRule::on_axis ? ", and not along its axis" : ""),
                "put them in one place, or say where the joint is: AT x y z");
  return {};
}

bool find_drive(const BuildContext& context, const DriveKeywords& words, const deck::Tagged& kind, int function, Drive& drive) {
  if (!kind.given()) {
    if (function == 0) return true;
    std::string noun = words.coordinate;
    for (char& c : noun) c = static_cast<char>(c | 0x20);  // lower case
    context.error(words.function, fmt::format("{} without {}", words.function, words.drive),
                  fmt::format("{0} {1} {2} f imposes the {3}, {0} SPEED {2} f the speed", words.drive, words.coordinate,
                              words.function, noun));
    return false;
  }
  if (function == 0) {
    context.error(words.drive, fmt::format("{} needs a function of time", words.drive),
                  fmt::format("{} f names a function of .FCT{}", words.function, words.unit));
    return false;
  }
  drive.rate_given = kind.is("SPEED");
  drive.function = context.function(function, words.function);
  return drive.function != nullptr;
}

void add_joint_nodes(JointCard& card) {
  card.add("N", &JointData::nodes, "the two nodes, a and b; 0 is the ground")
      .synonyms({"NODES", "NOEUDS"})
      .refers(deck::Reference::node)
      .required();
}

void add_joint_axis(JointCard& card) {
  card.add("AXIS", &JointData::axis, "direction of the axis, held by a, in the reference configuration")
      .synonyms({"AXE"})
      .required();
}

void add_joint_point(JointCard& card) {
  card.add("AT", &JointData::at, "joint point, in the reference configuration").unit(dimension::length);
}

void add_slide_drive(JointCard& card, const std::string& coordinate) {
  const bool slide = coordinate == "SLIDE";
  card.add("DRIVE", &JointData::drive, "imposes the motion by the function NF")
      .synonyms({"MOTEUR"})
      .option({coordinate, {slide ? "COURSE" : "LONGUEUR"}, slide ? "the function is the slide" : "the function is the length"})
      .option({"SPEED", {"VITESSE"}, "the function is its rate"});
  card.add("NF", &JointData::function, "function of time of the drive").refers(deck::Reference::function).at_least(0);
}

void add_slide_spring(JointCard& card) {
  card.add("K", &JointData::stiffness, "spring on the slide").unit(dimension::stiffness).at_least(0);
  card.add("C", &JointData::damping, "damper on the slide").unit(dimension::damping).at_least(0);
  card.add("SLIDE0", &JointData::slide0, "slide at which the spring is relaxed").unit(dimension::length);
}

void add_turn_drive(JointCard& card) {
  card.add("TURN", &JointData::turn, "imposes the turn by the function NFT")
      .synonyms({"ROTATION"})
      .option({"ANGLE", {}, "the function is the angle, radians"})
      .option({"SPEED", {"VITESSE"}, "the function is the speed, radians per time"});
  card.add("NFT", &JointData::turn_function, "function of time of the turn").refers(deck::Reference::function).at_least(0);
}

void add_turn_spring(JointCard& card) {
  card.add("KT", &JointData::turn_stiffness, "torsion spring, moment per radian")
      .unit(dimension::torsional_stiffness)
      .at_least(0);
  card.add("CT", &JointData::turn_damping, "torsion damper, moment per radian and time")
      .unit(dimension::torsional_damping)
      .at_least(0);
  card.add("ANGLE0", &JointData::angle0, "angle at which the torsion spring is relaxed").unit(dimension::angle);
}

std::optional<JointParts> start_joint(const JointData& data, const BuildContext& context, const std::string& joint,
                                      PointRule rule, bool has_axis) {
  JointParts parts;
  parts.has_axis = parts.drawn_axis = has_axis;
  if (has_axis) {
    const auto axis = unit_vector(context, "AXIS", data.axis);
    if (!axis) return {};
    const AxisTriad triad(*axis);
    parts.frame.e1 = triad.e1;
    parts.frame.e2 = triad.e2;
    parts.frame.e3 = triad.e3;
  }
  if (!check_nodes(context, {data.nodes[0], data.nodes[1]})) return {};
  const auto point = joint_point(context, data.nodes, data.at, joint, rule, parts.frame.e1);
  if (!point) return {};
  parts.nodes = data.nodes;
  parts.point = *point;
  parts.frame.arm_a = *point - context.nodes.at(data.nodes[0]);
  parts.frame.arm_b = *point - context.nodes.at(data.nodes[1]);
  return parts;
}

void release_rotations(JointParts& parts, bool axes_on_a) {
  // the ground's rotation is no unknown, and its reaction is complete
  parts.frame.turns_a = axes_on_a || parts.nodes[0] == 0 || parts.frame.arm_a != Vec3::Zero();
  parts.frame.turns_b = parts.nodes[1] == 0 || parts.frame.arm_b != Vec3::Zero();
  parts.has_moment = false;
}

bool add_slide(const JointData& data, const BuildContext& context, JointParts& parts) {
  JointCoordinate slide{Measure::gap_1, "SLIDE", "SLIDE_SPEED", data.stiffness, data.damping, data.slide0};
  if (!find_drive(context, {"DRIVE", "NF", "SLIDE", ""}, data.drive, data.function, slide.drive)) return false;
  parts.coordinates.push_back(slide);
  return true;
}

bool add_turn(const JointData& data, const BuildContext& context, JointParts& parts) {
  JointCoordinate turn{Measure::angle, "ANGLE", "SPEED", data.turn_stiffness, data.turn_damping, data.angle0 * degree};
  if (!find_drive(context, {"TURN", "NFT", "ANGLE", ", in radians"}, data.turn, data.turn_function, turn.drive)) return false;
  parts.coordinates.push_back(turn);
  return true;
}

}  // namespace engrane
