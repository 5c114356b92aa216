// SPDX-License-Identifier: BSD-3-Clause
// What the cards of joints share: nodes, axis, joint point, springs and drives of free coordinates.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "elements/common/friction_card.hpp"
#include "elements/joints/joint.hpp"
#include "model/registry.hpp"

namespace engrane::elements::joints {

/// Card data of one free coordinate. For angles: values in degrees, stiffness and damping per radian.
struct CoordinateData : SpringLawData {
  deck::Tagged drive;
  int function = 0;
  double stiffness = 0, damping = 0, relaxed = 0;
  std::optional<double> lower, upper;
  double stop_stiffness = 0, stop_exponent = 1;
  deck::Tagged stop_damping;
};
/// One of several such sets on the same card.
template <int Which>
struct NumberedCoordinate : CoordinateData {};

/// Card data of any joint; each kind declares the keywords it uses.
struct JointData : NumberedCoordinate<0>, NumberedCoordinate<1>, NumberedCoordinate<2>, NumberedCoordinate<3> {
  std::array<int, 2> nodes{};
  std::array<double, 3> axis{};
  std::optional<std::array<double, 3>> second;    ///< second direction: pin or shaft of B, or direction in the plane
  std::optional<std::array<double, 3>> at;        ///< joint point in the reference configuration
  std::optional<std::array<double, 3>> from, to;  ///< ends of a DISTANCE
  std::optional<std::array<double, 3>> on;        ///< a point on the axis of a POINT_CYLINDER
  double pitch = 0;                               ///< of a screw: advance per turn
  double both_stiffness = 0, both_damping = 0, both_relaxed = 0;  ///< for both slides, or both pins

  deck::Tagged friction;
  std::optional<double> friction_width;
  bool sticks = false;
  double radius = 0, collar = 0, bearing_length = 0, preload = 0;
  double flank = 0;  ///< thread flank angle, degrees

  CoordinateData& slide() { return static_cast<NumberedCoordinate<0>&>(*this); }    ///< also a length, or the first slide
  CoordinateData& slide_b() { return static_cast<NumberedCoordinate<1>&>(*this); }  ///< second slide
  CoordinateData& turn() { return static_cast<NumberedCoordinate<2>&>(*this); }     ///< also the turn about A's pin
  CoordinateData& turn_b() { return static_cast<NumberedCoordinate<3>&>(*this); }   ///< turn about B's pin
  const CoordinateData& slide() const { return static_cast<const NumberedCoordinate<0>&>(*this); }
  const CoordinateData& slide_b() const { return static_cast<const NumberedCoordinate<1>&>(*this); }
  const CoordinateData& turn() const { return static_cast<const NumberedCoordinate<2>&>(*this); }
  const CoordinateData& turn_b() const { return static_cast<const NumberedCoordinate<3>&>(*this); }
};

using JointCard = deck::Card<JointData>;

/// Default joint point when the nodes do not coincide.
enum class PointRule {
  one_place,  ///< none: the position matters
  on_axis,    ///< node b, if the line between the nodes is along the axis
  at_b,       ///< node b: the position affects only the reported moment
};

/// The joint point: AT, or the common position of the nodes, or the node that is not the ground, or the default given by
/// `rule`. `joint` is the name used in messages: "hinge".
std::optional<Vec3> joint_point(const BuildContext& context, const std::array<int, 2>& nodes,
                                const std::optional<std::array<double, 3>>& at, const std::string& joint, PointRule rule,
                                const Vec3& axis = Vec3::Zero());

/// Keywords and words that a card uses for a free coordinate.
struct CoordinateWords {
  std::string suffix;  ///< suffix of every keyword: K, KT
  std::string name;    ///< option that drives the coordinate: SLIDE, ANGLE, LENGTH; prefix of SLIDE0 etc.
  std::string thing;   ///< name in the help: "the slide"
  bool turns = false;  ///< an angle
  std::string drive = "DRIVE", function = "NF";  ///< including the suffix
};

namespace words {
extern const CoordinateWords slide;    ///< the only slide of a joint
extern const CoordinateWords length;   ///< the length of a rod
extern const CoordinateWords slide_2;  ///< slides in a plane
extern const CoordinateWords slide_3;
extern const CoordinateWords turn;   ///< the turn of a joint that also slides
extern const CoordinateWords angle;  ///< the only turn of a joint
extern const CoordinateWords pin_1;  ///< the pins of a universal joint
extern const CoordinateWords pin_2;
}  // namespace words

/// Declare keywords.
void add_joint_nodes(JointCard& card);
void add_joint_axis(JointCard& card);
void add_joint_point(JointCard& card);
/// The friction keywords of a joint.
struct FrictionWords {
  std::string radius = {};  ///< meaning of RADIUS; empty: no such keyword
  std::string collar = {};  ///< likewise THRUST
  std::string length = {};  ///< likewise LENGTH
  bool flank = false;       ///< whether FLANK exists
  bool needs_radius = true;
};
void add_joint_friction(JointCard& card, const FrictionWords& words);

/// DRIVE, K, C, LAW, CLAW, SLIDE0 or ANGLE0, MIN, MAX, KSTOP, EXP and DAMP of a free coordinate.
template <int Which>
void add_coordinate(JointCard& card, const CoordinateWords& words);

/// Reads nodes, axes and joint point. Returns nothing, with an error, if they are invalid. `has_axis`: AXIS is read.
std::optional<JointParts> start_joint(const JointData& data, const BuildContext& context, const std::string& joint,
                                      PointRule rule, bool has_axis = true);

/// Drops the rotations that the joint does not need: of nodes without an arm to the joint point and, for A, without axes.
void release_rotations(JointParts& parts, bool axes_on_a);

/// Builds a free coordinate from the card. Returns nothing, with an error, if the data are invalid.
std::optional<JointCoordinate> find_coordinate(const BuildContext& context, const CoordinateData& data,
                                               const CoordinateWords& words, Measure measure, const CoordinateNames& names);
/// Adds a free coordinate to the joint; returns false, with an error, if the data are invalid.
bool add_free(const BuildContext& context, JointParts& parts, const CoordinateData& data, const CoordinateWords& words,
              Measure measure, const CoordinateNames& names);
/// Adds the slide along e1, or the turn about it.
bool add_slide(const JointData& data, const BuildContext& context, JointParts& parts);
bool add_turn(const JointData& data, const BuildContext& context, JointParts& parts);
/// Declares the keywords of the slides across a normal e1, finds their axes, and adds the slides.
void add_plane_slides(JointCard& card);
bool find_plane_axes(const JointData& data, const BuildContext& context, JointParts& parts);
bool add_slides(const JointData& data, const BuildContext& context, JointParts& parts);
/// Data of one coordinate completed by the K and C of both, whose keywords have the suffix `both`. Returns nothing, with an
/// error, if both give the same quantity.
std::optional<CoordinateData> with_both(const BuildContext& context, const JointData& data, const CoordinateData& own,
                                        const CoordinateWords& words, const std::string& both);

/// Adds the friction given on the card, if any; returns false, with an error, if it is invalid.
bool add_friction(const JointData& data, const BuildContext& context, JointParts& parts, Rubbing kind,
                  const FrictionWords& words);

}  // namespace engrane::elements::joints
