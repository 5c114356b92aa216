// SPDX-License-Identifier: BSD-3-Clause
#include "elements/cams/cam.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "elements/cams/cam_contact.hpp"
#include "elements/cams/cam_design.hpp"
#include "elements/common/building.hpp"
#include "elements/common/friction_card.hpp"
#include "elements/common/stop_range.hpp"
#include "math/angle.hpp"

namespace engrane::elements::cams {

namespace {

/// A direction of the card, projected across the cam's axis, in global components. Reports an error if it is along the axis.
std::optional<Vec3> across(const BuildContext& context, const char* keyword, const std::array<double, 3>& value,
                           const Vec3& axis) {
  const auto direction = unit_vector(context, keyword, value);
  if (!direction) return {};
  const Vec3 in_plane = *direction - direction->dot(axis) * axis;
  if (in_plane.norm() < 1e-6) {
    context.error(keyword, fmt::format("{} is along AXIS", keyword), "give a direction in the plane of the cam, across its axis");
    return {};
  }
  return Vec3(in_plane.normalized());
}

/// Reports a keyword that has no meaning beside another one; returns whether it was given.
bool meaningless(const BuildContext& context, const char* keyword, const char* where, const char* cure) {
  if (!context.record.given(keyword)) return false;
  context.error(keyword, fmt::format("{} has no meaning {}", keyword, where), cure);
  return true;
}

std::optional<CamMotion> find_motion(const CamData& data, const BuildContext& context, bool arm) {
  const auto wrong = [&](const char* keyword, const std::string& what, const std::string& cure) {
    context.error(keyword, what, cure);
    return std::optional<CamMotion>();
  };
  const std::size_t n = data.motion.size() / 2;
  if (data.motion.size() % 2 != 0)
    return wrong("MOTION", fmt::format("MOTION has {} values", data.motion.size()),
                 "a pair for each segment: its width in degrees of the cam's turn, and the lift at its end");
  std::vector<CamLaw> laws;
  for (const std::string& name : data.laws) {
    std::string upper = name;
    for (char& c : upper)
      if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    const auto law = cam_law(upper);
    if (!law) return wrong("LAW", fmt::format("LAW does not know \"{}\"", name), cam_law_names());
    laws.push_back(*law);
  }
  if (laws.size() != 1 && laws.size() != n)
    return wrong("LAW", fmt::format("{} laws for {} segments", laws.size(), n),
                 "give one law for all, or one for each segment of MOTION");
  double sum = 0;
  std::vector<CamMotion::Segment> segments;
  const double unit = arm ? degree : 1;
  for (std::size_t k = 0; k < n; ++k) {
    const double width = data.motion[2 * k], lift = data.motion[2 * k + 1];
    if (!(width > 0))
      return wrong("MOTION", fmt::format("segment {} is {} degrees wide", k + 1, number(width)),
                   "pairs of width and lift: the width of a segment is positive");
    if (lift < 0)
      return wrong("MOTION", fmt::format("the lift at the end of segment {} is {}", k + 1, number(lift)),
                   "lifts count from the base circle and are not negative");
    sum += width;
    // a periodic motion starts where it ends
    const double from = segments.empty() ? unit * data.motion.back() : segments.back().to;
    segments.push_back({width * degree, from, unit * lift, laws.size() == 1 ? laws[0] : laws[k]});
  }
  if (std::abs(sum - 360) > 1e-9)
    return wrong("MOTION", fmt::format("the segments of MOTION make {} degrees: the profile does not close", number(sum)),
                 "their widths must sum to 360; a segment with the lift of the one before is a dwell");
  return CamMotion(std::move(segments), data.phase * degree);
}

/// The curve of a motion for the follower as placed in the reference configuration; the follower's direction is the x axis of
/// the plane.
std::unique_ptr<CamCurve> design_curve(const CamData& data, const BuildContext& context, const CamMotion& motion,
                                       const CamPlan& plan, const CamParts& parts) {
  const double start = *data.base + parts.radius;
  if (parts.flat) return envelope_of_face(motion, *data.base, plan.face.dot(plan.direction));
  if (parts.guide.kind == CamGuide::Kind::slide) {
    const double offset = plane_cross(plan.direction, plan.point);
    if (std::abs(offset) >= start) {
      context.error(
          "AT", fmt::format("the follower's way passes the centre at {:.6g}, and starts {:.6g} from it", std::abs(offset), start),
          "a larger BASE, or a follower nearer to the line through the centre");
      return nullptr;
    }
    return path_of_slide(motion, std::sqrt(start * start - offset * offset), offset);
  }
  const double arm = (plan.point - plan.pivot).norm(), between = plan.pivot.norm();
  const double cosine = (start * start - between * between - arm * arm) / (2 * between * arm);
  if (!(std::abs(cosine) < 1)) {
    context.error(
        "PIVOT",
        fmt::format("an arm of {:.6g} with its pivot {:.6g} from the centre does not reach the base circle: its end must come "
                    "to {:.6g} from the centre",
                    arm, between, start),
        "move PIVOT or the follower, or change BASE");
    return nullptr;
  }
  const double angle = std::acos(cosine);
  for (const CamMotion::Segment& s : motion.segments())
    if (s.to >= angle) {
      context.error("MOTION",
                    fmt::format("the arm cannot swing by {:.6g} degrees: after {:.6g} it points away from the cam", s.to / degree,
                                angle / degree),
                    "the lifts of an arm are angles in degrees");
      return nullptr;
    }
  return path_of_arm(motion, between, arm, angle, plane_cross(plan.pivot, plan.point) > 0 ? 1 : -1);
}

std::unique_ptr<CamCurve> table_curve(const CamData& data, const BuildContext& context) {
  const char* keyword = data.table.empty() ? "POLAR" : "TABLE";
  const std::vector<double>& values = data.table.empty() ? data.polar : data.table;
  if (values.size() % 2 != 0) {
    context.error(keyword, fmt::format("{} has {} values", keyword, values.size()),
                  data.table.empty() ? "pairs: an angle in degrees and a radius" : "pairs: x and y of each point");
    return nullptr;
  }
  std::size_t n = values.size() / 2;
  if (data.table.empty()) {
    std::vector<double> angle, radius;
    for (std::size_t k = 0; k < n; ++k) {
      angle.push_back(values[2 * k] * degree);
      radius.push_back(values[2 * k + 1]);
      if (!(radius.back() > 0) || (k > 0 && !(angle[k] > angle[k - 1]))) {
        context.error("POLAR", fmt::format("point {} is ({}, {})", k + 1, number(values[2 * k]), number(radius.back())),
                      "angles must increase from point to point, and radii are positive");
        return nullptr;
      }
    }
    const double reach = angle.back() - angle.front();
    const bool repeats = reach > whole_turn * (1 - 1e-12);
    if (reach > whole_turn * (1 + 1e-12) || (repeats && std::abs(radius.back() - radius.front()) > 1e-9 * radius.front())) {
      context.error("POLAR",
                    repeats && reach <= whole_turn * (1 + 1e-12)
                        ? fmt::format("the profile does not close: the radius is {} at first and {} a turn later",
                                      number(radius.front()), number(radius.back()))
                        : fmt::format("the angles reach over {} degrees, more than a turn", number(reach / degree)),
                    "angles within a turn; a last point a turn after the first must repeat its radius");
      return nullptr;
    }
    if (repeats) radius.back() = radius.front(), angle.back() = angle.front() + whole_turn;
    double widest = 0;
    for (std::size_t k = 0; k + 1 < n; ++k) widest = std::max(widest, angle[k + 1] - angle[k]);
    if (!repeats && whole_turn - reach > 3 * widest) {
      context.error("POLAR",
                    fmt::format("the profile does not close: no points between {} and {} degrees, and no others are more than "
                                "{:.6g} degrees apart",
                                number(angle.back() / degree), number(angle.front() / degree + 360), widest / degree),
                    "give points all round the cam");
      return nullptr;
    }
    if (n < 4) {
      context.error("POLAR", fmt::format("{} points are not enough for a profile", n), "give at least 4, better 30 and more");
      return nullptr;
    }
    return polar_curve(angle, radius);
  }
  std::vector<Vec2> points;
  for (std::size_t k = 0; k < n; ++k) points.emplace_back(values[2 * k], values[2 * k + 1]);
  double longest = 0, extent = 0;
  for (std::size_t k = 0; k + 1 < n; ++k) longest = std::max(longest, (points[k + 1] - points[k]).norm());
  for (const Vec2& p : points) extent = std::max(extent, p.norm());
  if (n > 1 && (points.back() - points.front()).norm() <= 1e-9 * extent) points.pop_back();
  n = points.size();
  if (n < 4) {
    context.error("TABLE", fmt::format("{} points are not enough for a profile", n), "give at least 4, better 30 and more");
    return nullptr;
  }
  for (std::size_t k = 0; k < n; ++k)
    if ((points[(k + 1) % n] - points[k]).norm() <= 1e-12 * extent) {
      context.error("TABLE", fmt::format("points {} and {} are in one place", k + 1, (k + 1) % n + 1), "leave one out");
      return nullptr;
    }
  const double gap = (points.front() - points.back()).norm();
  if (gap > 3 * longest) {
    context.error(
        "TABLE",
        fmt::format(
            "the profile does not close: its last point is {:.6g} from the first, and no others are more than {:.6g} apart", gap,
            longest),
        "give points all round the cam; the last may repeat the first");
    return nullptr;
  }
  return curve_through(points);
}

bool find_friction(const CamData& data, const BuildContext& context, CamParts& parts) {
  if (!data.friction.given()) return !meaningless(context, "VREG", "without FRICTION", "give FRICTION, or leave it out");
  if (!parts.flat && parts.radius > 0) {
    context.error("FRICTION", "a roller rolls on the profile without friction", "FOLLOWER KNIFE or FLAT slides");
    return false;
  }
  if (!data.friction_width) {
    context.error("FRICTION", "friction needs VREG, the sliding speed below which it is regularised",
                  "VREG v, well below the speeds of interest");
    return false;
  }
  FrictionLaw law;
  law.width = *data.friction_width;
  if (!read_friction(context, data.friction, law)) return false;
  parts.friction = law;
  return true;
}

/// Checks that exactly one of TABLE, POLAR and MOTION is given, with its own keywords only.
bool check_words(const CamData& data, const BuildContext& context) {
  const bool motion = !data.motion.empty();
  const int profiles = (data.table.empty() ? 0 : 1) + (data.polar.empty() ? 0 : 1) + (motion ? 1 : 0);
  if (profiles != 1) {
    context.error(profiles == 0 ? "N"
                  : motion      ? "MOTION"
                                : "POLAR",
                  profiles == 0 ? "a cam without a profile" : "more than one profile",
                  "one of TABLE x y .., POLAR angle radius .. and MOTION width lift .. with BASE");
    return false;
  }
  if (!data.follower.given()) return false;
  if (data.direction && data.pivot) {
    context.error("PIVOT", "DIRECTION and PIVOT both say how the follower moves", "DIRECTION for a slide, PIVOT for an arm");
    return false;
  }
  bool good = true;
  if (motion) {
    good = !meaningless(context, "ZERO", "with MOTION",
                        "the cam's angle is zero in the reference configuration; PHASE shifts the motion") &&
           !meaningless(context, "SIDE", "with MOTION", "INSIDE is for profiles from a table") && good;
    if (!data.base) {
      context.error("MOTION", "a motion needs its base circle", "BASE r: the least radius of the profile");
      good = false;
    }
    if (!data.direction && !data.pivot) {
      context.error("MOTION", "a motion needs the follower's way", "DIRECTION x y z of a slide, or PIVOT x y z of an arm");
      good = false;
    }
    if (data.pivot && data.follower.is("FLAT")) {
      context.error("PIVOT", "no profile is made for a flat face on an arm", "give its points by TABLE");
      good = false;
    }
  } else {
    for (const char* word : {"BASE", "PHASE", "LAW"})
      good = !meaningless(context, word, "without MOTION", "leave it out") && good;
    if (!data.zero) {
      context.error(data.table.empty() ? "POLAR" : "TABLE", "which way does the table's x axis point?",
                    "ZERO x y z: that direction in the reference configuration; y is AXIS x ZERO");
      good = false;
    }
  }
  if (!data.follower.is("FLAT")) {
    good = !meaningless(context, "NORMAL", "without a flat face", "FOLLOWER FLAT has one") && good;
  } else if (!data.normal && !data.direction) {
    context.error("FOLLOWER", "which way does the flat face look?", "NORMAL x y z: its normal, away from the cam");
    good = false;
  }
  if (!data.stiffness)
    for (const char* word : {"DAMP", "EXP"})
      good = !meaningless(context, word, "for a follower that is held to the profile", "give K: the follower then rests on it") &&
             good;
  return good;
}

std::unique_ptr<Element> build(const CamData& data, BuildContext& context) {
  if (!check_nodes(context, {data.nodes[0], data.nodes[1]}) || !check_words(data, context)) return nullptr;
  const auto axis = unit_vector(context, "AXIS", data.axis);
  if (!axis) return nullptr;
  const Vec3 &at_a = context.nodes.at(data.nodes[0]), &at_b = context.nodes.at(data.nodes[1]);
  CamParts parts;
  parts.nodes = data.nodes;
  parts.place = data.center ? to_vector(*data.center) : at_a;
  parts.center = parts.place - at_a;
  const Vec3 point = data.at ? to_vector(*data.at) : at_b;
  parts.follower = point;
  parts.point = point - at_b;
  parts.inside = data.side.is("INSIDE");
  parts.flat = data.follower.is("FLAT");
  if (data.follower.is("ROLLER")) {
    parts.radius = data.follower.values[0];
    if (!(parts.radius > 0)) {
      context.error("FOLLOWER", fmt::format("a roller of radius {}", number(parts.radius)),
                    "a positive radius, or FOLLOWER KNIFE");
      return nullptr;
    }
  }

  std::optional<Vec3> direction, face, zero;
  if (data.direction) {
    direction = across(context, "DIRECTION", *data.direction, *axis);
    if (!direction) return nullptr;
    parts.guide.kind = CamGuide::Kind::slide;
    parts.guide.direction = *direction;
  }
  if (parts.flat) {
    face = data.normal ? across(context, "NORMAL", *data.normal, *axis) : direction;
    if (!face) return nullptr;
    parts.face = *face;
  }
  const Vec3 to_pivot = data.pivot ? Vec3(to_vector(*data.pivot) - parts.place) : Vec3(Vec3::Zero());
  if (data.pivot) {
    parts.guide.kind = CamGuide::Kind::arm;
    parts.guide.pivot = to_vector(*data.pivot) - at_b;
    if (cross(*axis, to_pivot).norm() <= 1e-9 * to_pivot.norm() || same_place(to_vector(*data.pivot), point)) {
      const bool on_face = parts.flat && same_place(to_vector(*data.pivot), point);
      context.error("PIVOT", "no arm: its pivot is on the cam's axis or at the follower",
                    on_face ? "AT may be anywhere on the flat face: move it along the face, away from the pivot"
                            : "the place of the arm's pivot");
      return nullptr;
    }
  }
  const bool motion = !data.motion.empty();
  // the curve of a motion is generated in the axes of its follower
  if (motion)
    zero = parts.flat ? face : direction ? direction : across(context, "PIVOT", {to_pivot[0], to_pivot[1], to_pivot[2]}, *axis);
  else
    zero = across(context, "ZERO", *data.zero, *axis);
  if (!zero) return nullptr;
  parts.axes << *zero, cross(*axis, *zero), *axis;

  const auto flat = [&](const Vec3& v) { return Vec2(v.dot(parts.axes.col(0)), v.dot(parts.axes.col(1))); };
  CamPlan plan;
  plan.point = flat(point - parts.place);
  plan.direction = flat(parts.guide.direction);
  plan.pivot = flat(to_pivot);
  plan.face = flat(parts.face);
  std::unique_ptr<CamCurve> curve;
  if (motion) {
    plan.base = *data.base;
    if (parts.flat && !(plan.face.dot(plan.direction) > 0.1)) {
      context.error("NORMAL", "the face looks across the follower's way", "NORMAL within 80 degrees of DIRECTION");
      return nullptr;
    }
    const auto lift = find_motion(data, context, data.pivot.has_value());
    if (!lift || !check_side(context, plan, parts, *lift)) return nullptr;
    curve = design_curve(data, context, *lift, plan, parts);
  } else {
    curve = table_curve(data, context);
  }
  if (!curve) return nullptr;
  parts.profile = std::make_shared<CamProfile>(std::move(curve), motion ? parts.radius : 0.0, parts.inside);
  if (data.stiffness) {
    parts.law = StopLaw{*data.stiffness, data.exponent};
    parts.law->reach = parts.profile->greatest();
    if (!set_stop_damping(data.damping, context, "DAMP", *parts.law)) return nullptr;
    if (data.damping.is("REST"))
      parts.derived.push_back({"damping d of Hunt and Crossley", parts.law->hunt, Dimension{-1, 0, 1, 0}});
  }
  if (!check_design(context, plan, parts)) return nullptr;

  if (!find_friction(data, context, parts)) return nullptr;
  if (motion) check_place(context, plan, parts);
  return std::make_unique<Cam>(context.record.id, std::move(parts));
}

}  // namespace

ElementType cam_type() {
  deck::Card<CamData> card("CAM", {"CAME"}, "Cam: a knife edge, a roller or a flat face on a closed profile");
  card.numbered()
      .chapter("Rigid kinematic joints")
      .describe(
          "Body a carries the profile, in the plane across AXIS through CENTER; body b carries the follower's point AT. The "
          "profile is a closed smooth curve through a TABLE of points or POLAR radii, or the one that gives the follower a "
          "MOTION when the cam turns: segments of cam angle with the lift at their ends, equal lifts a dwell, on the base circle "
          "BASE. Without K the follower is held to the profile (a groove, a second cam); with K it rests on it as a STOP does, "
          "and may leave it. A roller or a flat face with K on a TABLE or POLAR profile with hollows touches at up to three "
          "places at "
          "once, such as both flanks of a notch. The contact acts in the plane of the cam; along the axis the follower is free.")
      .example(
          "I 5 CAM N 1 2  AXIS 0 0 1  BASE 0.03  MOTION 90 0.01 60 0.01 90 0 120 0  LAW CYCLOIDAL  $\n"
          "      FOLLOWER ROLLER 0.008  DIRECTION 0 1 0")
      .example(
          "I 6 CAM N 1 3  AXIS 0 0 1  BASE 0.03  MOTION 120 8 60 8 120 0 60 0  LAW \"POLY345\" \"POLY345\" \"POLY4567\" "
          "\"POLY345\"  $\n"
          "      FOLLOWER ROLLER 0.008  PIVOT 0.1 0 0  K 1D8 EXP 1.11  DAMP HUNT 0.3")
      .example(
          "I 7 CAM N 1 4  AXIS 0 0 1  ZERO 1 0 0  POLAR 0 0.04 45 0.038 90 0.034 135 0.031 180 0.03 225 0.031 270 0.034 315 "
          "0.038  $\n      FOLLOWER FLAT  DIRECTION 0 1 0  FRICTION CONST 0.1  VREG 1D-4");
  card.add("N", &CamData::nodes, "cam body a and follower body b; 0 is the ground")
      .synonyms({"NODES", "NOEUDS"})
      .refers(deck::Reference::node)
      .required();
  card.add("AXIS", &CamData::axis, "axis of the cam, held by a, in the reference configuration").synonyms({"AXE"}).required();
  card.add("CENTER", &CamData::center, "centre of the profile; default: node a").synonyms({"CENTRE"}).unit(dimension::length);
  card.add("ZERO", &CamData::zero, "x axis of TABLE and POLAR; y is AXIS x ZERO").synonyms({"ORIGINE"});
  card.add("TABLE", &CamData::table, "x1 y1 x2 y2 ...: points of the profile, all round")
      .values(8, 20000)
      .unit(dimension::length);
  card.add("POLAR", &CamData::polar, "angle radius ...: of points of the profile, angles increasing within a turn, in degrees")
      .synonyms({"POLAIRE"})
      .values(8, 20000);
  card.add("MOTION", &CamData::motion,
           "width lift ...: for each segment its width in degrees of cam angle and the lift at its end; degrees with PIVOT")
      .synonyms({"MOUVEMENT"})
      .values(2, 200);
  card.add("LAW", &CamData::laws,
           "CYCLOIDAL, MODIFIED_SINE, POLY345, POLY4567 or HARMONIC: one for all segments, or one each in quotes")
      .synonyms({"LOI"});
  card.add("BASE", &CamData::base, "radius of the base circle of MOTION").unit(dimension::length).positive();
  card.add("PHASE", &CamData::phase, "turn of the cam at which MOTION begins").unit(dimension::angle);
  card.add("SIDE", &CamData::side, "where the follower is")
      .synonyms({"COTE"})
      .option({"OUTSIDE", {"EXTERIEUR"}, "outside the profile"})
      .option({"INSIDE", {"INTERIEUR"}, "within it: an internal cam"});
  card.add("FOLLOWER", &CamData::follower, "what touches the profile")
      .synonyms({"POUSSOIR"})
      .option({"KNIFE", {"COUTEAU"}, "a knife edge: the point AT"})
      .option({"ROLLER", {"GALET"}, "r: a roller about AT", 1, 1, dimension::length})
      .option({"FLAT", {"PLAT"}, "a flat face through AT, across NORMAL"})
      .required();
  card.add("AT", &CamData::at, "the follower's point on b, in the reference configuration; default: node b")
      .unit(dimension::length);
  card.add("NORMAL", &CamData::normal, "normal of the flat face, away from the cam; default: DIRECTION").synonyms({"NORMALE"});
  card.add("DIRECTION", &CamData::direction, "the follower slides this way when it lifts");
  card.add("PIVOT", &CamData::pivot, "the follower swings about this place").unit(dimension::length);
  card.add("K", &CamData::stiffness,
           "contact stiffness: force at a penetration of one; without it the follower is held to the profile")
      .synonyms({"RAIDEUR"})
      .positive();
  card.add("EXP", &CamData::exponent, "exponent of the penetration").synonyms({"EXPOSANT"}).at_least(1);
  add_stop_damping(card.add("DAMP", &CamData::damping, "damping of the contact; none when not given").synonyms({"AMOR"}));
  add_friction_options(card.add("FRICTION", &CamData::friction, "friction of a knife edge or a flat face; needs VREG"), false);
  card.add("VREG", &CamData::friction_width,
           "sliding speed below which FRICTION is regularised: surfaces that should stick creep")
      .synonyms({"V0"})
      .unit(dimension::velocity)
      .positive();
  return element_type(card, build);
}

}  // namespace engrane::elements::cams
