// SPDX-License-Identifier: BSD-3-Clause
#include "elements/cams/cam_design.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "elements/common/building.hpp"

namespace engrane::elements::cams {

namespace {

/// Direction of motion of the follower's point when it is at q in the cam: a unit vector away from the cam, or nothing if the
/// point cannot be there.
std::optional<Vec2> way_at(const Vec2& q, const CamPlan& plan, const CamParts& parts) {
  const double distance = q.norm();
  if (parts.guide.kind == CamGuide::Kind::slide) {
    // relative to the cam the slide rotates about the centre, with a constant offset from it
    const double offset = plane_cross(plan.direction, plan.point), square = distance * distance - offset * offset;
    if (!(square > 0)) return {};
    return Vec2((std::sqrt(square) * q - offset * turned_left(q)) / (distance * distance));
  }
  if (parts.guide.kind == CamGuide::Kind::arm) {
    const double arm = (plan.point - plan.pivot).norm(), between = plan.pivot.norm();
    const double cosine = (distance * distance + arm * arm - between * between) / (2 * distance * arm);
    if (!(std::abs(cosine) < 1)) return {};
    // from the line to the centre by the angle of the triangle, on the pivot's side
    const double sine = (plane_cross(plan.pivot, plan.point) > 0 ? 1 : -1) * std::sqrt(1 - cosine * cosine);
    const Vec2 inwards = -q / distance, to_pivot = cosine * inwards + sine * turned_left(inwards);
    const Vec2 way = turned_left(to_pivot);
    return Vec2(way.dot(q) < 0 ? -way : way);
  }
  return {};
}

double angle_between(const Vec2& a, const Vec2& b) { return std::atan2(std::abs(plane_cross(a, b)), a.dot(b)); }

/// Smallest radius of curvature of the envelope of a face that moves by slope times the lift: ρ = base + slope (s + s″)
/// (Norton, eq. 7.31). Where it is negative the envelope has a cusp and turns back.
double least_face_radius(const CamMotion& motion, double base, double slope) {
  double least = std::numeric_limits<double>::infinity();
  constexpr int samples = 36000;
  for (int k = 0; k < samples; ++k) {
    const Jet lift = motion.at(2 * std::numbers::pi * k / samples);
    least = std::min(least, base + slope * (lift.f + lift.d2));
  }
  return least;
}

/// Largest angle between the contact normal and the follower's direction of motion; nothing if the follower does not reach
/// every point.
std::optional<double> greatest_pressure_angle(const CamPlan& plan, const CamParts& parts) {
  if (parts.guide.kind == CamGuide::Kind::none) return {};
  if (parts.flat) {
    if (parts.guide.kind == CamGuide::Kind::arm) return {};
    return angle_between(plan.face, plan.direction);
  }
  const double out = parts.radius - parts.profile->inset();
  bool reached = true;
  const auto angle = [&](const CamFoot& f) {
    const auto way = way_at(f.p + out * f.n, plan, parts);
    if (!way) reached = false;
    return way ? angle_between(f.n, *way) : 0.0;
  };
  const CamFoot worst = parts.profile->least([&](const CamFoot& f) { return -angle(f); });
  if (!reached) return {};
  return angle(worst);
}

bool check_face(const BuildContext& context, const CamPlan& plan, const char* keyword, const CamFoot& hollow, CamParts& parts) {
  if (const CamMotion* motion = parts.profile->curve().motion()) {
    const double radius = least_face_radius(*motion, plan.base, plan.face.dot(plan.direction));
    if (radius > 0) {
      parts.derived.push_back({"least radius of curvature of the profile", radius, dimension::length});
      return true;
    }
    context.error("BASE",
                  fmt::format("the profile is undercut and crosses itself: its least radius of curvature, base + lift + lift'', "
                              "is {:.6g}",
                              radius),
                  fmt::format("a flat face needs BASE above {:.6g}", plan.base - radius));
    return false;
  }
  if (hollow.curvature > 0 || parts.law) return true;
  const std::string what = fmt::format("the profile is hollow or straight at ({}, {}), where a flat face does not reach",
                                       number(hollow.p[0]), number(hollow.p[1]));
  context.error(keyword, what,
                "a face that is held to the profile needs one that is convex everywhere; or give K: it then rests on it");
  return false;
}

/// Warns of a profile undercut by the roller, and checks that no hollow is smaller than the roller.
bool check_roller(const BuildContext& context, const char* keyword, const CamFoot& sharp, const CamFoot& hollow,
                  const CamParts& parts) {
  const double inset = parts.profile->inset(), out = parts.radius - inset;
  if (inset > 0 && sharp.curvature > 0 && 1 / sharp.curvature <= inset)
    context.diagnostics.warning(context.record.where("FOLLOWER"),
                                fmt::format("the profile is undercut: the roller has a radius of {}, and the path of its centre "
                                            "one of {:.6g} at cam angle {:.4g}",
                                            number(parts.radius), 1 / sharp.curvature, std::fmod(sharp.s / degree + 720, 360)),
                                "a larger BASE, a wider segment or a smaller roller; the path is followed all the same");
  constexpr double nearly_fits = 1.02;
  const double room = -1 / hollow.curvature;
  if (!(hollow.curvature < 0) || !(room <= out)) return true;
  if (parts.law) {
    if (out <= nearly_fits * room)
      context.diagnostics.warning(context.record.where(keyword),
                                  fmt::format("a roller of radius {} nearly fits into the hollow of radius {:.6g} at ({}, {})",
                                              number(parts.radius), room, number(hollow.p[0]), number(hollow.p[1])),
                                  "its two contacts there are so close that they count as one, and the force jumps where they "
                                  "part: make it fit, or clearly "
                                  "larger");
    return true;
  }
  const std::string what = fmt::format("a roller of radius {} does not fit into the hollow of radius {:.6g} at ({}, {})",
                                       number(parts.radius), room, number(hollow.p[0]), number(hollow.p[1]));
  context.error(keyword, what, "a smaller roller, or a profile with wider hollows; or give K: it then touches both sides");
  return false;
}

/// Where the follower of a motion is, and where its profile has it at cam angle zero.
struct FollowerPlace {
  double given = 0, agreed = 0;  ///< distance from the centre; of a flat face along its normal
  Vec2 point = Vec2::Zero();     ///< the follower's point where it agrees
  double base = 0;               ///< the base circle that agrees with the place given; not positive: none does
};

/// The inverse of the curves of cam_curve.hpp at cam angle zero.
FollowerPlace find_place(const CamPlan& plan, const CamParts& parts, double lift) {
  const double start = plan.base + parts.radius;
  if (parts.flat) {
    const double slope = plan.face.dot(plan.direction), height = plan.point.dot(plan.face), agreed = plan.base + slope * lift;
    return {height, agreed, plan.point + (agreed - height) / slope * plan.direction, height - slope * lift};
  }
  FollowerPlace place;
  place.given = plan.point.norm();
  if (parts.guide.kind == CamGuide::Kind::slide) {
    const double offset = plane_cross(plan.direction, plan.point), along = plan.point.dot(plan.direction);
    const double way = std::sqrt(start * start - offset * offset) + lift;
    place.point = plan.point + (std::copysign(way, along) - along) * plan.direction;
    if (std::abs(along) > lift) place.base = std::hypot(std::abs(along) - lift, offset) - parts.radius;
  } else {
    const double between = plan.pivot.norm(), arm = (plan.point - plan.pivot).norm();
    const double cosine = (start * start - between * between - arm * arm) / (2 * between * arm);
    const double side = plane_cross(plan.pivot, plan.point) > 0 ? 1 : -1;
    const Vec2 out = plan.pivot / between;
    const auto end = [&](double angle) {
      return Vec2(plan.pivot + arm * (std::cos(angle) * out + side * std::sin(angle) * turned_left(out)));
    };
    place.point = end(std::acos(cosine) - lift);
    const double on_base = angle_between(plan.pivot, plan.point - plan.pivot) + lift;
    if (on_base < std::numbers::pi) place.base = end(on_base).norm() - parts.radius;
  }
  place.agreed = place.point.norm();
  return place;
}

}  // namespace

bool check_side(const BuildContext& context, const CamPlan& plan, const CamParts& parts, const CamMotion& motion) {
  constexpr double rounding = 1e-9;
  if (parts.flat) {
    const double height = plan.point.dot(plan.face);
    if (height >= -rounding * plan.base) return true;
    const bool normal = context.record.given("NORMAL");
    context.error(normal ? "NORMAL" : "DIRECTION",
                  fmt::format("the flat face looks into the cam: it is {:.6g} behind the cam's centre", -height),
                  normal ? "NORMAL points away from the cam: turn it round, or move AT to the other side of the centre"
                         : "the face lifts along DIRECTION: turn it round, or move AT to the other side of the centre");
    return false;
  }
  if (parts.guide.kind != CamGuide::Kind::slide) return true;
  // a follower that never lifts is on a circle, which looks the same from all sides
  if (std::none_of(motion.segments().begin(), motion.segments().end(), [](const auto& s) { return s.to > 0; })) return true;
  const double along = plan.point.dot(plan.direction);
  if (along >= -rounding * plan.base) return true;
  context.error("DIRECTION",
                fmt::format("DIRECTION points into the cam: along it the follower is {:.6g} behind the cam's centre", -along),
                "the follower lifts along DIRECTION: turn it round, or move AT to the other side of the centre");
  return false;
}

void check_place(const BuildContext& context, const CamPlan& plan, const CamParts& parts) {
  constexpr double tolerance = 1e-3;  // of the base circle: places are often given by four digits
  constexpr double lash = 0.1;        // a follower that rests on its cam may have play: valves have up to a few per cent
  const FollowerPlace place = find_place(plan, parts, parts.profile->curve().motion()->at(0).f);
  const double gap = place.given - place.agreed;
  if (!(std::abs(gap) > tolerance * plan.base) || (parts.law && gap > 0 && gap <= lash * plan.base)) return;
  Vec3 at = parts.follower;
  const Vec2 shift = place.point - plan.point;
  at += shift[0] * parts.axes.col(0) + shift[1] * parts.axes.col(1);
  for (double& x : at)
    if (std::abs(x) < 1e-9 * plan.base) x = 0;
  const std::string base = place.base > 0 ? fmt::format(", and so does BASE {:.6g}", place.base) : "";
  context.diagnostics.warning(context.record.where("BASE"),
                              fmt::format("the {} is {:.6g} from the cam's centre{}, and {:.6g} on the profile at cam angle 0",
                                          parts.flat         ? "flat face"
                                          : parts.radius > 0 ? "roller's centre"
                                                             : "knife edge",
                                          place.given, parts.flat ? " along its normal" : "", place.agreed),
                              fmt::format("AT {:.6g} {:.6g} {:.6g} agrees with BASE{}{}", at[0], at[1], at[2],
                                          parts.radius > 0 ? " and the roller" : "", base));
}

bool check_design(const BuildContext& context, const CamPlan& plan, CamParts& parts) {
  const CamProfile& profile = *parts.profile;
  const char* keyword = profile.curve().motion() ? "MOTION" : context.record.given("TABLE") ? "TABLE" : "POLAR";
  const auto tell = [&](const char* name, double value, Dimension d = dimension::length) {
    parts.derived.push_back({name, value, d});
  };
  const CamFoot sharp = profile.least([](const CamFoot& f) { return -f.curvature; });
  const CamFoot hollow = profile.least([](const CamFoot& f) { return f.curvature; });
  if (parts.flat) {
    if (!check_face(context, plan, keyword, hollow, parts)) return false;
  }
  if (const auto place = profile.crossing()) {
    context.error(
        keyword,
        fmt::format("the {} crosses itself near ({}, {})", profile.inset() > 0 ? "path of the roller's centre" : "profile",
                    number((*place)[0]), number((*place)[1])),
        "give the points in the order in which they follow each other round the cam");
    return false;
  }
  if (!parts.flat && !check_roller(context, keyword, sharp, hollow, parts)) return false;

  parts.several = parts.law && hollow.curvature < 0 && !profile.curve().motion() && (parts.flat || parts.radius > 0);

  const auto radius = [&](const CamFoot& f) { return (f.p - profile.inset() * f.n).norm(); };
  tell("base circle", radius(profile.least(radius)));
  tell("greatest radius", radius(profile.least([&](const CamFoot& f) { return -radius(f); })));
  if (!(parts.flat && profile.curve().motion())) {
    if (sharp.curvature > 0) tell("least radius of curvature of the profile", 1 / sharp.curvature - profile.inset());
    if (hollow.curvature < 0) tell("radius of the tightest hollow", -1 / hollow.curvature + profile.inset());
  }
  if (parts.radius > 0 && sharp.curvature > 0)
    tell("least radius of curvature of the roller's path", 1 / sharp.curvature + parts.radius - profile.inset());
  if (parts.guide.kind == CamGuide::Kind::slide) tell("offset of the slide", plane_cross(plan.direction, plan.point));
  if (parts.guide.kind == CamGuide::Kind::arm) tell("length of the arm", (plan.point - plan.pivot).norm());
  if (const auto angle = greatest_pressure_angle(plan, parts)) tell("greatest pressure angle", *angle, dimension::angle);
  return true;
}

}  // namespace engrane::elements::cams
