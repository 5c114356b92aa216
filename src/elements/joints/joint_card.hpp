// SPDX-License-Identifier: BSD-3-Clause
// What the cards of joints have in common: nodes, axis, joint point, springs and drives of free coordinates.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "elements/common/friction_card.hpp"
#include "elements/joints/joint.hpp"
#include "model/registry.hpp"

namespace engrane::elements::joints {

/// What a card says of one free coordinate. Of a turn: angles in degrees, stiffness and damping per radian.
struct CoordinateData : SpringLawData {
  deck::Tagged drive;
  int function = 0;
  double stiffness = 0, damping = 0, relaxed = 0;
  std::optional<double> lower, upper;
  double stop_stiffness = 0, stop_exponent = 1;
  deck::Tagged stop_damping;
};
/// One of several in the same card.
template <int Which>
struct NumberedCoordinate : CoordinateData {};

/// The card of any joint; each kind declares the keywords it has.
struct JointData : NumberedCoordinate<0>, NumberedCoordinate<1>, NumberedCoordinate<2>, NumberedCoordinate<3> {
  std::array<int, 2> nodes{};
  std::array<double, 3> axis{};
  std::optional<std::array<double, 3>> second;    ///< second direction: pin or shaft of B, or direction in the plane
  std::optional<std::array<double, 3>> at;        ///< joint point in the reference configuration
  std::optional<std::array<double, 3>> from, to;  ///< ends of a DISTANCE
  std::optional<std::array<double, 3>> on;        ///< a point of the axis of a POINT_CYLINDER
  double pitch = 0;                               ///< of a screw, per turn
  double both_stiffness = 0, both_damping = 0, both_relaxed = 0;  ///< of both slides, or of both pins

  deck::Tagged friction;
  std::optional<double> friction_width;
  bool sticks = false;
  double radius = 0, collar = 0, bearing_length = 0, preload = 0;
  double flank = 0;  ///< of a thread, degrees

  CoordinateData& slide() { return static_cast<NumberedCoordinate<0>&>(*this); }    ///< or length, or first slide
  CoordinateData& slide_b() { return static_cast<NumberedCoordinate<1>&>(*this); }  ///< second slide
  CoordinateData& turn() { return static_cast<NumberedCoordinate<2>&>(*this); }     ///< or turn about A's pin
  CoordinateData& turn_b() { return static_cast<NumberedCoordinate<3>&>(*this); }   ///< turn about B's pin
  const CoordinateData& slide() const { return static_cast<const NumberedCoordinate<0>&>(*this); }
  const CoordinateData& slide_b() const { return static_cast<const NumberedCoordinate<1>&>(*this); }
  const CoordinateData& turn() const { return static_cast<const NumberedCoordinate<2>&>(*this); }
  const CoordinateData& turn_b() const { return static_cast<const NumberedCoordinate<3>&>(*this); }
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

/// How a card speaks of a free coordinate.
struct CoordinateWords {
  std::string suffix;  ///< behind every keyword: K, KT
  std::string name;    ///< option that drives the coordinate itself: SLIDE, ANGLE, LENGTH; with 0 where its spring is relaxed
  std::string thing;   ///< in the help: "the slide"
  bool turns = false;  ///< an angle
  std::string drive = "DRIVE", function = "NF";  ///< the suffix included
};

namespace words {
extern const CoordinateWords slide;    ///< the one slide of a joint
extern const CoordinateWords length;   ///< that of a rod
extern const CoordinateWords slide_2;  ///< slides in a plane
extern const CoordinateWords slide_3;
extern const CoordinateWords turn;   ///< the turn of a joint that slides too
extern const CoordinateWords angle;  ///< the one turn of a joint
extern const CoordinateWords pin_1;  ///< of a universal joint
extern const CoordinateWords pin_2;
}  // namespace words

/// Declarations of keywords.
void add_joint_nodes(JointCard& card);
void add_joint_axis(JointCard& card);
void add_joint_point(JointCard& card);
/// Which keywords of friction a joint has.
struct FrictionWords {
  std::string radius = {};  ///< what RADIUS is; empty: it has none
  std::string collar = {};  ///< THRUST
  std::string length = {};  ///< LENGTH
  bool flank = false;       ///< FLANK
  bool needs_radius = true;
};
void add_joint_friction(JointCard& card, const FrictionWords& words);

/// DRIVE, K, C, LAW, CLAW, SLIDE0 or ANGLE0, MIN, MAX, KSTOP, EXP and DAMP of a free coordinate.
template <int Which>
void add_coordinate(JointCard& card, const CoordinateWords& words);

/// Nodes, axes and joint point; empty, with an error, when they make no joint. `has_axis` reads AXIS.
std::optional<JointParts> start_joint(const JointData& data, const BuildContext& context, const std::string& joint,
                                      PointRule rule, bool has_axis = true);

/// Without levers and axes the rotations of the nodes do not matter, and the joint asks for none.
void release_rotations(JointParts& parts, bool axes_on_a);

/// The free coordinate with what the card gives for it; empty, with an error, when that is faulty.
std::optional<JointCoordinate> find_coordinate(const BuildContext& context, const CoordinateData& data,
                                               const CoordinateWords& words, Measure measure, const CoordinateNames& names);
/// Adds one to the joint; false with an error.
bool add_free(const BuildContext& context, JointParts& parts, const CoordinateData& data, const CoordinateWords& words,
              Measure measure, const CoordinateNames& names);
/// The same of the slide along e1, and of the turn about it.
bool add_slide(const JointData& data, const BuildContext& context, JointParts& parts);
bool add_turn(const JointData& data, const BuildContext& context, JointParts& parts);
/// Keywords of the slides across a normal e1, their axes, and the slides.
void add_plane_slides(JointCard& card);
bool find_plane_axes(const JointData& data, const BuildContext& context, JointParts& parts);
bool add_slides(const JointData& data, const BuildContext& context, JointParts& parts);
/// What is said of one coordinate with what K, C of both (`both` behind them) add; empty with an error when both give the same.
std::optional<CoordinateData> with_both(const BuildContext& context, const JointData& data, const CoordinateData& own,
                                        const CoordinateWords& words, const std::string& both);

/// Friction of the card, if any; false with an error.
bool add_friction(const JointData& data, const BuildContext& context, JointParts& parts, Rubbing kind,
                  const FrictionWords& words);

}  // namespace engrane::elements::joints
