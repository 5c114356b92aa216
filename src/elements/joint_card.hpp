// SPDX-License-Identifier: BSD-3-Clause
// What the cards of joints have in common: nodes, axis, joint point, springs and drives of free coordinates.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "elements/joint.hpp"
#include "model/registry.hpp"

namespace engrane {

/// The card of any joint; each kind declares the keywords it has.
struct JointData {
  std::array<int, 2> nodes{};
  std::array<double, 3> axis{};
  std::optional<std::array<double, 3>> second;    ///< second direction: pin of B, or direction in the plane
  std::optional<std::array<double, 3>> at;        ///< joint point in the reference configuration
  std::optional<std::array<double, 3>> from, to;  ///< ends of a DISTANCE
  deck::Tagged drive;                             ///< of the slide or length
  int function = 0;
  double stiffness = 0, damping = 0, slide0 = 0;
  deck::Tagged turn;  ///< drive of the angle
  int turn_function = 0;
  double turn_stiffness = 0, turn_damping = 0, angle0 = 0;  ///< per radian; degrees
  double pitch = 0;                                         ///< of a screw, per turn
};

using JointCard = deck::Card<JointData>;

/// Where the joint point may be by default when the nodes are apart.
enum class PointRule {
  one_place,  ///< nowhere: the place matters
  on_axis,    ///< at node b when the nodes are on one line along the axis
  at_b,       ///< at node b: the place matters to the reported moment only
};

/// The joint point: AT, or where both nodes are, or where the one is that is not the ground, or what the rule says.
/// `joint` is for the message: "hinge".
std::optional<Vec3> joint_point(const BuildContext& context, const std::array<int, 2>& nodes,
                                const std::optional<std::array<double, 3>>& at, const std::string& joint, PointRule rule,
                                const Vec3& axis = Vec3::Zero());

/// A drive as a card names it.
struct DriveKeywords {
  std::string drive, function;  ///< keywords: DRIVE and NF
  std::string coordinate;       ///< option that gives the coordinate itself: ANGLE; the other is SPEED
  std::string unit;             ///< "in radians"
};

/// The drive behind `DRIVE ANGLE NF f`; false, with an error, when a part is missing.
bool find_drive(const BuildContext& context, const DriveKeywords& words, const deck::Tagged& kind, int function, Drive& drive);

/// Declarations of keywords.
void add_joint_nodes(JointCard& card);
void add_joint_axis(JointCard& card);
void add_joint_point(JointCard& card);
void add_slide_drive(JointCard& card, const std::string& coordinate);
void add_slide_spring(JointCard& card);
void add_turn_drive(JointCard& card);
void add_turn_spring(JointCard& card);

/// Nodes, axes and joint point; empty, with an error, when they make no joint. `has_axis` reads AXIS.
std::optional<JointParts> start_joint(const JointData& data, const BuildContext& context, const std::string& joint,
                                      PointRule rule, bool has_axis = true);

/// Without levers and axes the rotations of the nodes do not matter, and the joint asks for none.
void release_rotations(JointParts& parts, bool axes_on_a);

/// Adds the free slide along e1, or turn about it, with what the card gives for it; false when its drive is faulty.
bool add_slide(const JointData& data, const BuildContext& context, JointParts& parts);
bool add_turn(const JointData& data, const BuildContext& context, JointParts& parts);

}  // namespace engrane
