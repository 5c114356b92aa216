// SPDX-License-Identifier: BSD-3-Clause
#include "elements/joints/joint_card.hpp"

#include <fmt/format.h>

#include "elements/common/building.hpp"

namespace engrane::elements::joints {

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

void add_joint_friction(JointCard& card, const FrictionWords& words) {
  add_friction_options(card.add("FRICTION", &JointData::friction, "dry friction, from the joint's own reaction"));
  card.add("VREG", &JointData::friction_width, "regularises friction below this sliding speed: surfaces that should stick creep")
      .synonyms({"V0", "VS"})
      .unit(dimension::velocity)
      .positive();
  card.add("STICK", &JointData::sticks,
           "Coulomb's law at every speed, surfaces that stop are held exactly; the default without VREG")
      .synonyms({"ADHERENCE", "COLLE"});
  if (!words.radius.empty())
    card.add("RADIUS", &JointData::radius, words.radius).synonyms({"RAYON"}).unit(dimension::length).at_least(0);
  if (!words.collar.empty())
    card.add("THRUST", &JointData::collar, words.collar).synonyms({"COLLET"}).unit(dimension::length).at_least(0);
  if (!words.length.empty())
    card.add("LENGTH", &JointData::bearing_length, words.length).synonyms({"LONGUEUR"}).unit(dimension::length).at_least(0);
  if (words.flank)
    card.add("FLANK", &JointData::flank, "half angle of the thread in the plane of the axis: 0 square, 30 metric, 15 trapezoidal")
        .unit(dimension::angle)
        .at_least(0)
        .below(90);
  card.add("PRELOAD", &JointData::preload, "force that presses the surfaces together besides the load")
      .synonyms({"PRECHARGE"})
      .unit(dimension::force)
      .at_least(0);
}

namespace words {
const CoordinateWords slide{"", "SLIDE", "the slide"};
const CoordinateWords length{"", "LENGTH", "the length"};
const CoordinateWords slide_2{"2", "SLIDE", "the first slide", false, "DRIVE2", "NF2"};
const CoordinateWords slide_3{"3", "SLIDE", "the second slide", false, "DRIVE3", "NF3"};
const CoordinateWords turn{"T", "ANGLE", "the angle", true, "TURN", "NFT"};
const CoordinateWords angle{"", "ANGLE", "the angle", true};
const CoordinateWords pin_1{"1", "ANGLE", "the angle of a's pin", true, "DRIVE1", "NF1"};
const CoordinateWords pin_2{"2", "ANGLE", "the angle of b's pin", true, "DRIVE2", "NF2"};
}  // namespace words

template <int Which>
void add_coordinate(JointCard& card, const CoordinateWords& words) {
  using Data = NumberedCoordinate<Which>;
  // pointers to members of the common base, as members of this particular derived struct
  deck::Tagged Data::*drive = &CoordinateData::drive;
  deck::Tagged Data::*damping_of_stop = &CoordinateData::stop_damping;
  int Data::*function = &CoordinateData::function;
  std::optional<double> Data::*lower = &CoordinateData::lower;
  std::optional<double> Data::*upper = &CoordinateData::upper;
  const auto real = [](double CoordinateData::*member) { return static_cast<double Data::*>(member); };

  const std::string& s = words.suffix;
  const std::string unit = words.turns ? ", radians" : "";
  std::vector<std::string> french;
  if (words.name == "SLIDE") french = {"COURSE"};
  if (words.name == "LENGTH") french = {"LONGUEUR"};
  card.add(words.drive, drive, "imposes " + words.thing + " by the function " + words.function)
      .synonyms({words.drive == "TURN" ? std::string("ROTATION") : "MOTEUR" + s})
      .option({words.name, french, "the function is " + words.thing + unit})
      .option({"SPEED", {"VITESSE"}, words.turns ? "the function is the speed, radians per time" : "the function is its rate"});
  card.add(words.function, function, "function of time of " + words.drive).refers(deck::Reference::function).at_least(0);
  card.add("K" + s, real(&CoordinateData::stiffness),
           words.turns ? "torsion spring on " + words.thing + ", moment per radian" : "spring on " + words.thing)
      .unit(words.turns ? dimension::torsional_stiffness : dimension::stiffness)
      .at_least(0);
  card.add("C" + s, real(&CoordinateData::damping),
           words.turns ? "torsion damper, moment per radian and time" : "damper on " + words.thing)
      .unit(words.turns ? dimension::torsional_damping : dimension::damping)
      .at_least(0);
  add_spring_law<Data>(card, words.turns ? "angle in radians" : words.thing.substr(4), words.turns ? "moment" : "force", s);
  card.add(words.name + "0" + (words.turns && s == "T" ? "" : s), real(&CoordinateData::relaxed),
           words.thing + " at which the spring is relaxed")
      .unit(words.turns ? dimension::angle : dimension::length);
  const Dimension place = words.turns ? dimension::angle : dimension::length;
  card.add("MIN" + s, lower, "lower stop of " + words.thing).unit(place);
  card.add("MAX" + s, upper, "upper stop of " + words.thing).unit(place);
  card.add("KSTOP" + s, real(&CoordinateData::stop_stiffness),
           std::string("stiffness of the stops: ") + (words.turns ? "moment at one radian" : "force at a penetration of one"))
      .positive();
  card.add("EXP" + s, real(&CoordinateData::stop_exponent), "exponent of the penetration of the stops")
      .synonyms({"EXPOSANT" + s})
      .at_least(1);
  add_stop_damping(card.add("DAMP" + s, damping_of_stop, "damping of the stops; none when not given").synonyms({"AMOR" + s}));
}
template void add_coordinate<0>(JointCard& card, const CoordinateWords& words);
template void add_coordinate<1>(JointCard& card, const CoordinateWords& words);
template void add_coordinate<2>(JointCard& card, const CoordinateWords& words);
template void add_coordinate<3>(JointCard& card, const CoordinateWords& words);

std::optional<JointParts> start_joint(const JointData& data, const BuildContext& context, const std::string& joint,
                                      PointRule rule, bool has_axis) {
  JointParts parts;
  parts.has_axis = parts.drawn_axis = has_axis;
  if (has_axis) {
    const auto axis = unit_vector(context, "AXIS", data.axis);
    if (!axis) return {};
    const AxisTriad triad(*axis);
    parts.frame.set_axes(triad.e1, triad.e2);
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
  // the ground's rotation is not an unknown, and with it the reaction is complete
  parts.frame.turns_a = axes_on_a || parts.nodes[0] == 0 || parts.frame.arm_a != Vec3::Zero();
  parts.frame.turns_b = parts.nodes[1] == 0 || parts.frame.arm_b != Vec3::Zero();
  parts.has_moment = false;
}

namespace {

/// Reads `DRIVE ANGLE NF f`. Returns false, with an error, if a part is missing.
bool find_drive(const BuildContext& context, const CoordinateData& data, const CoordinateWords& words, Drive& drive) {
  if (!data.drive.given()) {
    if (data.function == 0) return true;
    std::string noun = words.name;
    for (char& c : noun) c = static_cast<char>(c | 0x20);  // lower case
    context.error(
        words.function, fmt::format("{} without {}", words.function, words.drive),
        fmt::format("{0} {1} {2} f imposes the {3}, {0} SPEED {2} f the speed", words.drive, words.name, words.function, noun));
    return false;
  }
  if (data.function == 0) {
    context.error(words.drive, fmt::format("{} needs a function of time", words.drive),
                  fmt::format("{} f names a function of .FCT{}", words.function, words.turns ? ", in radians" : ""));
    return false;
  }
  drive.rate_given = data.drive.is("SPEED");
  drive.function = context.function_of_time(data.function, words.function);
  return drive.function != nullptr;
}

bool find_stop(const BuildContext& context, const CoordinateData& data, const CoordinateWords& words, StopRange& stop) {
  const std::string& s = words.suffix;
  const bool limits = data.lower || data.upper;
  const std::string stiffness = "KSTOP" + s;
  if (limits && !(data.stop_stiffness > 0)) {
    context.error((data.lower ? "MIN" : "MAX") + s, fmt::format("a stop without stiffness: {} is missing", stiffness),
                  fmt::format("{} k: {}", stiffness,
                              words.turns ? "moment at one radian beyond the limit" : "force at one unit beyond the limit"));
    return false;
  }
  if (!limits && (data.stop_stiffness > 0 || data.stop_damping.given())) {
    const std::string word = data.stop_stiffness > 0 ? stiffness : "DAMP" + s;
    context.error(word, fmt::format("{} describes stops, and there are none", word),
                  fmt::format("MIN{0} s, MAX{0} s or both", s));
    return false;
  }
  const auto range = StopRange::of(context, {data.lower, data.upper, data.stop_stiffness, data.stop_exponent, data.stop_damping},
                                   {"MIN" + s, "MAX" + s, "DAMP" + s}, words.turns ? degree : 1);
  if (range) stop = *range;
  return range.has_value();
}

}  // namespace

std::optional<JointCoordinate> find_coordinate(const BuildContext& context, const CoordinateData& data,
                                               const CoordinateWords& words, Measure measure, const CoordinateNames& names) {
  JointCoordinate c{measure, names};
  const auto law =
      SpringLaw::of(context, data, data.stiffness, data.damping, -data.relaxed * (words.turns ? degree : 1), 0.1, words.suffix);
  if (!law || !find_drive(context, data, words, c.drive) || !find_stop(context, data, words, c.stop)) return {};
  c.law = *law;
  c.relaxed = data.relaxed * (words.turns ? degree : 1);
  return c;
}

bool add_free(const BuildContext& context, JointParts& parts, const CoordinateData& data, const CoordinateWords& words,
              Measure measure, const CoordinateNames& names) {
  auto found = find_coordinate(context, data, words, measure, names);
  if (found) parts.coordinates.push_back(std::move(*found));
  return found.has_value();
}

bool add_slide(const JointData& data, const BuildContext& context, JointParts& parts) {
  return add_free(context, parts, data.slide(), words::slide, Measure::gap_1, CoordinateNames::of("SLIDE", "SLIDE_SPEED"));
}

bool add_turn(const JointData& data, const BuildContext& context, JointParts& parts) {
  return add_free(context, parts, data.turn(), words::turn, Measure::angle, CoordinateNames::of("ANGLE", "SPEED"));
}

std::optional<CoordinateData> with_both(const BuildContext& context, const JointData& data, const CoordinateData& own,
                                        const CoordinateWords& words, const std::string& both) {
  CoordinateData merged = own;
  const auto merge = [&](const char* letter, double common, double& value, bool law) {
    if (common == 0) return true;
    if (value != 0 || law) {
      context.error(letter + both,
                    fmt::format("{0}{1} gives both {2}, and {0}{3} or its law one of them", letter, both,
                                words.turns ? "pins" : "slides", words.suffix),
                    fmt::format("leave {}{} out", letter, both));
      return false;
    }
    value = common;
    return true;
  };
  if (!merge("K", data.both_stiffness, merged.stiffness, own.law.given()) ||
      !merge("C", data.both_damping, merged.damping, own.damping_law != 0))
    return {};
  if (merged.relaxed == 0) merged.relaxed = data.both_relaxed;
  return merged;
}

bool add_slides(const JointData& data, const BuildContext& context, JointParts& parts) {
  const auto second = with_both(context, data, data.slide(), words::slide_2, "");
  const auto third = with_both(context, data, data.slide_b(), words::slide_3, "");
  return second && third &&
         add_free(context, parts, *second, words::slide_2, Measure::gap_2, CoordinateNames::of("SLIDE_2", "SLIDE_2_SPEED")) &&
         add_free(context, parts, *third, words::slide_3, Measure::gap_3, CoordinateNames::of("SLIDE_3", "SLIDE_3_SPEED"));
}

void add_plane_slides(JointCard& card) {
  card.add("DIR", &JointData::second, "direction of the first slide; any by default");
  card.add("K", &JointData::both_stiffness, "spring on both slides").unit(dimension::stiffness).at_least(0);
  card.add("C", &JointData::both_damping, "damper on both slides").unit(dimension::damping).at_least(0);
  add_coordinate<0>(card, words::slide_2);
  add_coordinate<1>(card, words::slide_3);
}

bool find_plane_axes(const JointData& data, const BuildContext& context, JointParts& parts) {
  if (!data.second) return true;
  const auto along = unit_vector(context, "DIR", *data.second);
  if (!along) return false;
  const Vec3 in_plane = *along - parts.frame.e1 * along->dot(parts.frame.e1);
  if (in_plane.norm() < 1e-6) {
    context.error("DIR", "DIR is along the normal AXIS", "give a direction in the plane");
    return false;
  }
  parts.frame.set_axes(parts.frame.e1, in_plane.normalized());
  return true;
}

bool add_friction(const JointData& data, const BuildContext& context, JointParts& parts, Rubbing kind,
                  const FrictionWords& words) {
  if (!data.friction.given()) {
    for (const auto& [keyword, given] : {std::pair<const char*, bool>{"VREG", data.friction_width.has_value()},
                                         {"STICK", data.sticks},
                                         {"RADIUS", !words.radius.empty() && data.radius > 0},
                                         {"THRUST", data.collar > 0},
                                         {"LENGTH", data.bearing_length > 0},
                                         {"FLANK", data.flank > 0},
                                         {"PRELOAD", data.preload > 0}})
      if (given) {
        context.error(keyword, fmt::format("{} describes friction, and there is none", keyword), "give FRICTION CONST mu");
        return false;
      }
    return true;
  }
  JointFriction f;
  f.kind = kind;
  f.law.rests = !data.friction_width;
  if (data.sticks && data.friction_width) {
    context.error("VREG", "STICK regularises nothing, VREG does", "remove one of them");
    return false;
  }
  if (words.needs_radius && !(data.radius > 0)) {
    context.error(
        "FRICTION", "friction needs RADIUS",
        fmt::format("RADIUS r: {}{}", words.radius,
                    data.collar > 0 ? "; where only the collar rubs, as in a disc clutch, one far smaller than THRUST" : ""));
    return false;
  }
  f.law.width = data.friction_width.value_or(0);
  if (!read_friction(context, data.friction, f.law)) return false;
  if (!words.radius.empty()) f.radius = data.radius;
  f.collar = data.collar;
  f.length = data.bearing_length;
  f.preload = data.preload;
  parts.friction.push_back(f);
  return true;
}

}  // namespace engrane::elements::joints
