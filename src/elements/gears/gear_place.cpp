// SPDX-License-Identifier: BSD-3-Clause
#include "elements/gears/gear_place.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "elements/common/building.hpp"
#include "elements/gears/gear_kinds.hpp"
#include "elements/gears/gear_report.hpp"

namespace engrane::elements::gears {

namespace {

/// In an internal pair the wheel with more teeth is the ring.
std::optional<std::array<double, 2>> internal_cones(const std::array<int, 2>& teeth, const BuildContext& context) {
  if (teeth[0] == teeth[1]) {
    context.error("INTERNAL", fmt::format("an internal pair with {} teeth on both wheels", teeth[0]),
                  "the ring gear needs more teeth than the pinion");
    return {};
  }
  const bool ring_is_a = teeth[0] > teeth[1];
  return std::array<double, 2>{ring_is_a ? std::numbers::pi : 0.0, ring_is_a ? 0.0 : std::numbers::pi};
}

/// Cone angles in radians, from whichever of CONE, SHAFT, INTERNAL and AXISB is given.
std::optional<std::array<double, 2>> cones_of(const GearData& data, const std::array<int, 2>& teeth, const GearSite& site,
                                              const BuildContext& context) {
  const int ways = (data.cone ? 1 : 0) + (data.shaft_angle ? 1 : 0) + (data.internal ? 1 : 0);
  if (ways > 1) {
    context.error(data.internal ? "INTERNAL" : "SHAFT", "CONE, SHAFT and INTERNAL exclude each other: each fixes the cone angles",
                  "keep one of them");
    return {};
  }
  if (data.cone) return std::array<double, 2>{(*data.cone)[0] * degree, (*data.cone)[1] * degree};
  if (data.internal) return internal_cones(teeth, context);
  if (data.shaft_angle) return bevel_cones(*data.shaft_angle * degree, teeth, site);
  if (data.axis_b && site.x_b) {
    const Vec3 axle_b = to_vector(*data.axis_b).normalized();
    if (const auto shaft = shaft_angle_of_axles(site.x_a, site.axle, *site.x_b, axle_b)) return bevel_cones(*shaft, teeth, site);
  }
  return std::array<double, 2>{0, 0};
}

void set_helices(GearDesign& design, const GearData& data) {
  if (data.helix.empty()) return;
  design.helix[0] = paper_helix(data.helix[0] * degree, design.cone[0]);
  design.helix[1] = data.helix.size() > 1 ? paper_helix(data.helix[1] * degree, design.cone[1]) : -design.helix[0];
}

bool check_radii(const GearDesign& design, const GearData& data, const BuildContext& context) {
  if (!data.radii) return true;
  bool good = true;
  for (const std::size_t wheel : {std::size_t{0}, std::size_t{1}}) {
    const double given = (*data.radii)[wheel], needed = design.cut ? design.cut->reference_radius(wheel) : design.radius(wheel);
    if (std::abs(given - needed) <= typing_tolerance * needed) continue;
    good = false;
    context.error("R",
                  fmt::format("{} radius of wheel {}: {} given, {} needed by 2 r cos(helix) = z m_n",
                              design.cut ? "reference" : "pitch", wheel == 0 ? "A" : "B", number(given), number(needed)),
                  "leave R out: it follows from Z, MN and HELIX");
  }
  return good;
}

/// ", or …": the sum of profile shifts with which parallel axles would fit, if such teeth can be cut.
std::string shift_that_fits(const GearDesign& design, const GearData& data, double distance) {
  if (design.parallel_kind() == 0) return {};
  const CutTeeth cut = design.cut ? *design.cut : reference_cut(design, data);
  const auto angle = cut.working_angle_at(distance);
  if (!angle) return {};
  const double sum = cut.sum_of_shifts_at(*angle);
  if (std::abs(sum) > 2) return {};
  return fmt::format(", or shift the profiles: a sum of shifts of {} fits, and with one value of X the other follows",
                     number(sum));
}

/// Checks that the pair closes at the positions of its nodes.
bool check_closure(const GearDesign& design, const GearData& data, const Vec3& x_a, const Vec3& x_b, const Vec3& axle,
                   const BuildContext& context) {
  const int kind = design.parallel_kind();
  if ((kind == -1 && design.teeth[1] <= design.teeth[0]) || (kind == -2 && design.teeth[0] <= design.teeth[1])) {
    context.error("CONE",
                  fmt::format("wheel {} is the ring gear (cone 180) of {} teeth, its pinion has {}", kind == -1 ? "B" : "A",
                              design.teeth[kind == -1 ? 1 : 0], design.teeth[kind == -1 ? 0 : 1]),
                  "the ring gear needs more teeth than the pinion; INTERNAL finds the ring by itself");
    return false;
  }
  const Closure c = closure(design, x_a, x_b, axle);
  if (c.distance_needed < typing_tolerance * c.size) {
    context.error("N", "the contact point has no place: both wheels would be the same circle",
                  "an internal pair needs wheels of different radii (theory, equation 12)");
    return false;
  }
  bool good = true;
  if (std::abs(c.distance_given - c.distance_needed) > typing_tolerance * c.size) {
    good = false;
    context.error(
        "N",
        fmt::format(
            "{}: {} given, {} needed by Z, MN, HELIX and {}",
            kind != 0 ? "centre distance" : "distance of the centre of wheel B from the axle of wheel A",
            number(c.distance_given), number(c.distance_needed),
            design.cut ? fmt::format("the sum of shifts {}", number(design.cut->shift[0] + design.cut->shift[1])) : "the cones"),
        fmt::format("move node {} or {}{}", data.nodes[0], data.nodes[1], shift_that_fits(design, data, c.distance_given)));
  }
  if (std::abs(c.offset_given - c.offset_needed) > typing_tolerance * c.size) {
    good = false;
    const bool mirrored = std::abs(c.offset_given + c.offset_needed) <= typing_tolerance * c.size;
    context.error("N",
                  fmt::format("offset of the centre of wheel B from the plane of wheel A, along AXIS: {} given, {} needed",
                              number(c.offset_given), number(c.offset_needed)),
                  mirrored ? "turn AXIS round, or change the sign of both cone angles"
                           : fmt::format("move node {} or {}", data.nodes[0], data.nodes[1]));
  }
  return good;
}

/// Checks the axle of B. AXISB is a line: its sense does not matter.
bool check_axle_b(const GearDesign& design, const GearData& data, const PitchFrames& frames, const BuildContext& context) {
  const Vec3 needed = frames.xi.col(0);
  if (!data.axis_b) {
    if (!data.kind.given() && std::abs(std::sin(design.cone[0])) + std::abs(std::sin(design.cone[1])) < 1e-9 &&
        design.parallel_kind() == 0)
      context.diagnostics.warning(
          context.record.where("HELIX"),
          fmt::format("these helices make crossed axles: B turns about ({}, {}, {})", number(needed[0]), number(needed[1]),
                      number(needed[2])),
          "give AXISB to confirm; for parallel axles give HELIX one value, or opposite hands (equal hands inside a ring)");
    return true;
  }
  const Vec3 given = to_vector(*data.axis_b).normalized();
  const double off = cross(given, needed).norm();
  if (off <= typing_tolerance) return true;
  const double angle = std::atan2(off, std::abs(given.dot(needed))) / degree;
  context.error(
      "AXISB",
      fmt::format("axle of wheel B: ({}, {}, {}) given, ({}, {}, {}) needed by the cones and helices, {:.6g} degrees away",
                  number(given[0]), number(given[1]), number(given[2]), number(needed[0]), number(needed[1]), number(needed[2]),
                  angle),
      "parallel axles need opposite hands (equal hands inside a ring); crossed ones |helix A + helix B| = their angle");
  return false;
}

/// The design without KIND, from cone and helix angles.
std::optional<GearDesign> design_of_angles(const GearData& data, const GearSite& site, const BuildContext& context) {
  const auto teeth = gear_teeth_numbers(data, site, context);
  if (!check_long_form(data, context) || !teeth) return {};
  const auto cones = cones_of(data, *teeth, site, context);
  if (!cones) return {};
  GearDesign design;
  design.teeth = *teeth;
  design.normal_module = *data.normal_module;
  design.pressure_angle = data.pressure_angle * degree;
  design.cone = *cones;
  set_helices(design, data);
  return design;
}

/// The working pair of a card that describes the cut of its teeth. The shifts determine the centre distance; or, with one value
/// of X, the centre distance given by DISTANCE or the nodes determines the other shift.
std::optional<GearDesign> cut_design(const GearDesign& reference, const GearData& data, const GearSite& site,
                                     const BuildContext& context) {
  if (reference.parallel_kind() == 0) {
    for (const auto& [keyword, given] : given_cut_keywords(data))
      if (given)
        context.error(keyword, fmt::format("{} is for wheels on parallel axles, and these cross or meet", keyword),
                      "leave it out: such wheels have addendum m_n and no shift");
    return {};
  }
  CutTeeth cut = reference_cut(reference, data);
  std::optional<double> distance = data.center_distance;
  if (data.shift.size() == 1) {
    if (!distance && site.x_b) distance = cross(site.axle, Vec3(*site.x_b - site.x_a)).norm();
    if (!distance) {
      context.error("X", "X has one value, and no centre distance decides the other",
                    "give X two values, DISTANCE with a KIND, or the place of wheel B instead of PLACE");
      return {};
    }
    const auto angle = cut.working_angle_at(*distance);
    if (!angle) {
      context.error("X",
                    fmt::format("no profile shift makes a centre distance of {}: the base circles are {} apart",
                                number(*distance), number(cut.reference_distance() * std::cos(cut.transverse_pressure_angle()))),
                    fmt::format("without shift it would be {}", number(cut.reference_distance())));
      return {};
    }
    cut.working_pressure_angle = *angle;
    cut.shift[1] = cut.sum_of_shifts_at(*angle) - cut.shift[0];
  } else {
    const double sum = cut.shift[0] + cut.shift[1];
    const auto angle = sum == 0 ? std::optional(cut.transverse_pressure_angle()) : cut.working_angle_of(sum);
    if (!angle) {
      context.error("X", fmt::format("a sum of shifts of {}: the base circles would touch", number(sum)),
                    "take a sum of shifts nearer to zero, or a larger ALPHA");
      return {};
    }
    cut.working_pressure_angle = *angle;
    if (distance && std::abs(*distance - cut.distance()) > typing_tolerance * cut.distance()) {
      const auto at = cut.working_angle_at(*distance);
      context.error(
          "DISTANCE",
          fmt::format("centre distance: {} given, {} needed by Z, the module and the sum of shifts {}", number(*distance),
                      number(cut.distance()), number(sum)),
          at ? fmt::format("a sum of shifts of {} fits; with one value of X the other follows", number(cut.sum_of_shifts_at(*at)))
             : "leave DISTANCE out: it follows");
      return {};
    }
  }
  if (!set_tips(cut, data, {"wheel A", "wheel B"}, context)) return {};
  return working_design(reference, cut);
}

/// The data of the card before the position of B is checked.
struct Intention {
  GearSite site;
  GearDesign design;
};

std::optional<Intention> intention(const GearData& data, const BuildContext& context) {
  const bool nodes_good = check_nodes(context, {data.nodes[0], data.nodes[1]});
  const auto axle = unit_vector(context, "AXIS", data.axis);
  const bool axle_b_good = !data.axis_b || unit_vector(context, "AXISB", *data.axis_b);
  if (!nodes_good || !axle || !axle_b_good) return {};
  Intention i;
  i.site.x_a = context.nodes.at(data.nodes[0]);
  i.site.axle = *axle;
  if (!data.place) i.site.x_b = context.nodes.at(data.nodes[1]);
  const auto design = data.kind.given() ? design_of_kind(data, i.site, context) : design_of_angles(data, i.site, context);
  if (!design) return {};
  i.design = *design;
  if (data.describes_cut()) {
    const auto cut = cut_design(*design, data, i.site, context);
    if (!cut) return {};
    i.design = *cut;
  } else if (design->parallel_kind() != 0 && !check_plain_tips(*design, {"wheel A", "wheel B"}, context)) {
    return {};
  }
  return i;
}

/// The direction of PLACE, projected across the axle.
std::optional<Vec3> place_direction(const GearData& data, const Vec3& axle, const BuildContext& context) {
  if (data.nodes[1] == 0) {
    context.error("PLACE", "wheel B is at node 0, the ground, which stays at the origin",
                  "name the wheels the other way round, so that B is the one to be placed");
    return {};
  }
  const auto direction = unit_vector(context, "PLACE", *data.place);
  if (!direction) return {};
  const Vec3 across = *direction - direction->dot(axle) * axle;
  if (across.norm() < 1e-6) {
    context.error("PLACE", "PLACE points along AXIS",
                  "it is the direction from the centre of A to the contact point, across the axle");
    return {};
  }
  return across.normalized();
}

}  // namespace

std::optional<GearPlacement> place_gear(const GearData& data, const BuildContext& context) {
  const auto intended = intention(data, context);
  if (!intended) return {};
  const GearDesign& design = intended->design;
  const Vec3 &x_a = intended->site.x_a, &axle = intended->site.axle, &x_b = context.nodes.at(data.nodes[1]);
  if (data.place && !place_direction(data, axle, context)) return {};
  const bool radii_good = check_radii(design, data, context);  // evaluate both checks, so that one run reports all errors
  if (!check_closure(design, data, x_a, x_b, axle, context) || !radii_good) return {};
  GearPlacement placement{design, pitch_frames(design, x_a, x_b, axle)};
  if (!check_axle_b(design, data, placement.frames, context)) return {};
  warn_about_teeth(design, data, context);
  return placement;
}

std::optional<NodePlacement> place_second_wheel(const GearData& data, const BuildContext& context) {
  if (!data.place) return {};
  const auto intended = intention(data, context);
  if (!intended) return {};
  const auto toward = place_direction(data, intended->site.axle, context);
  if (!toward) return {};
  return NodePlacement{data.nodes[1], data.nodes[0],
                       centre_of_second_wheel(intended->design, intended->site.x_a, intended->site.axle, *toward)};
}

}  // namespace engrane::elements::gears
