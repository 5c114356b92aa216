// SPDX-License-Identifier: BSD-3-Clause
#include "elements/gears/gear_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>

#include "base/text.hpp"
#include "elements/common/building.hpp"

namespace engrane::elements::gears {

namespace {

const char* name_of(std::size_t wheel) { return wheel == 0 ? "A" : "B"; }

bool is_ring(const GearDesign& design, std::size_t wheel) { return std::cos(design.cone[wheel]) < 0; }

/// Whether the helix makes the wheel a worm: a lead angle below 45 degrees.
bool is_worm(const GearDesign& design, std::size_t wheel) {
  return design.parallel_kind() == 0 && std::abs(design.helix[wheel]) > std::numbers::pi / 4 &&
         std::abs(std::sin(design.cone[wheel])) < 1e-9;
}

/// Distance of the axles along their common normal, from the triple product of x_AB with both.
double axle_distance(const GearDesign& design, const Mat3& Z) {
  const double sine = std::hypot(Z(1, 0), Z(2, 0));
  if (sine < 1e-9) return std::abs(design.radius(0) - Z(1, 1) * design.radius(1));
  return std::abs(design.radius(0) * Z(2, 0) + design.radius(1) * Z(0, 2)) / sine;
}

}  // namespace

double virtual_teeth(const GearDesign& design, std::size_t wheel) { return design.teeth[wheel] / std::cos(design.cone[wheel]); }

double least_teeth(const GearDesign& design, std::size_t wheel) {
  const double sine = std::sin(design.transverse_pressure_angle(wheel));
  return 2 * std::cos(design.helix[wheel]) / (sine * sine);
}

std::optional<double> usable_contact_ratio(const GearDesign& design) {
  const auto full = contact_ratio(design);
  if (!full) return {};
  const double sine = std::sin(design.transverse_pressure_angle(0));
  double path = 0;
  for (const std::size_t i : both_wheels) {
    const std::size_t mate = 1 - i;
    const double side = *virtual_path_of_contact(design, i), cosine = std::cos(design.cone[mate]);
    // a ring's involute starts outside its base circle; a crown wheel's has no start
    path += cosine > 1e-9 ? std::min(side, design.radius(mate) / cosine * sine) : side;
  }
  return path / (std::numbers::pi * design.transverse_module(0) * std::cos(design.transverse_pressure_angle(0)));
}

int hunting_period(const std::array<int, 2>& teeth) { return teeth[1] / std::gcd(teeth[0], teeth[1]); }

std::optional<InternalClearance> internal_clearance(const GearDesign& design) {
  const int kind = design.parallel_kind();
  if (kind >= 0) return {};
  const std::size_t ring = kind == -1 ? 1 : 0, pinion = 1 - ring;
  const double alpha = design.transverse_pressure_angle(0), cosine = std::cos(alpha);
  const double r_1 = design.radius(pinion), r_2 = design.radius(ring), distance = r_2 - r_1;
  const double tip_1 = tip_radius(design, pinion), tip_2 = tip_radius(design, ring);
  if (tip_2 <= r_2 * cosine) return {};
  InternalClearance c;
  c.involute = std::sqrt(tip_2 * tip_2 - r_2 * r_2 * cosine * cosine) - distance * std::sin(alpha);
  const double cross_1 = (tip_2 * tip_2 - tip_1 * tip_1 - distance * distance) / (2 * distance * tip_1);
  const double cross_2 = (tip_2 * tip_2 - tip_1 * tip_1 + distance * distance) / (2 * distance * tip_2);
  if (std::abs(cross_1) > 1 || std::abs(cross_2) > 1) {
    c.tips = std::numbers::pi;  // the tip circles do not cross
    return c;
  }
  const double z_1 = design.teeth[pinion], z_2 = design.teeth[ring];
  c.tips = z_1 * (involute(std::acos(r_1 * cosine / tip_1)) + std::acos(cross_1)) -
           z_2 * (involute(std::acos(r_2 * cosine / tip_2)) + std::acos(cross_2)) + (z_2 - z_1) * involute(alpha);
  return c;
}

void put_cut(std::vector<Derived>& list, const CutTeeth& cut, const std::array<std::string, 2>& names) {
  using namespace dimension;
  const auto put = [&](std::string name, double value, Dimension d) { list.push_back({std::move(name), value, d}); };
  const auto each = [&](const std::string& name, Dimension d, auto value) {
    for (const std::size_t i : both_wheels)
      if (cut.teeth[i] != 0) put(name + " of " + names[i], value(i), d);
  };
  const bool rack = cut.teeth[1] == 0;
  put("transverse module", cut.transverse_module(), length);
  each("profile shift", none, [&](std::size_t i) { return cut.shift[i]; });
  if (!rack) put("sum of profile shifts", cut.shift[0] + cut.shift[1], none);
  each("reference radius", length, [&](std::size_t i) { return cut.reference_radius(i); });
  if (!rack) each("working pitch radius", length, [&](std::size_t i) { return cut.working_radius(i); });
  each("base radius", length, [&](std::size_t i) { return cut.base_radius(i); });
  each("tip radius", length, [&](std::size_t i) { return cut.tip[i]; });
  each("root radius", length, [&](std::size_t i) { return cut.root_radius(i); });
  each("tip alteration, over the module,", none, [&](std::size_t i) { return cut.tip_alteration(i); });
  each("tooth thickness at the reference circle, normal,", length, [&](std::size_t i) { return cut.thickness(i); });
  each("tooth thickness at the tip, normal,", length, [&](std::size_t i) { return cut.tip_thickness(i); });
  if (!rack) {
    each("tip clearance", length, [&](std::size_t i) { return cut.tip_clearance(i); });
    put("centre distance without shift", cut.reference_distance(), length);
  }
  put("transverse pressure angle", cut.transverse_pressure_angle(), angle);
  if (!rack) put("working transverse pressure angle", cut.working_pressure_angle, angle);
}

std::string drawn_cut(const CutTeeth& cut, std::size_t wheel, double radius) {
  return R"(, "addendum": )" + format_number(std::abs(cut.tip[wheel] - radius)) + R"(, "dedendum": )" +
         format_number(std::abs(radius - cut.root_radius(wheel))) + R"(, "thickness": )" +
         format_number(cut.thickness_at(wheel, radius)) + R"(, "pressure_angle": )" +
         format_number(cut.working_pressure_angle / degree);
}

void put_backlash(std::vector<Derived>& list, const ToothLaw& teeth, double pressure_angle) {
  if (!(teeth.backlash > 0)) return;
  list.push_back({"backlash along the circumference", teeth.backlash, dimension::length});
  list.push_back({"backlash normal to the flanks", teeth.backlash * std::cos(pressure_angle), dimension::length});
}

std::vector<Derived> gear_report(const GearDesign& design, const PitchFrames& frames, const ToothLaw& teeth, double width) {
  using namespace dimension;
  std::vector<Derived> list;
  const Mat3 Z = wheel_to_wheel(design);
  const int kind = design.parallel_kind();
  const auto put = [&](std::string name, double value, Dimension d) { list.push_back({std::move(name), value, d}); };
  const auto each = [&](const std::string& name, Dimension d, auto value) {
    for (const std::size_t i : both_wheels) put(name + " of wheel " + name_of(i), value(i), d);
  };
  const auto vector = [&](const std::string& name, const Vec3& v, Dimension d) {
    for (int k = 0; k < 3; ++k) put(name + ", " + "xyz"[k], v[k], d);
  };

  put("normal module", design.cut_module(), length);
  if (design.cut) {
    put_cut(list, *design.cut, {"wheel A", "wheel B"});
  } else {
    each("transverse module", length, [&](std::size_t i) { return design.transverse_module(i); });
    each("pitch radius", length, [&](std::size_t i) { return design.radius(i); });
    each("tip radius, addendum m_n,", length, [&](std::size_t i) { return tip_radius(design, i); });
    if (kind != 0)
      each("base radius", length,
           [&](std::size_t i) { return design.radius(i) * std::cos(design.transverse_pressure_angle(i)); });
    each("transverse pressure angle", angle, [&](std::size_t i) { return design.transverse_pressure_angle(i); });
  }
  each("cone angle", angle, [&](std::size_t i) { return design.cone[i]; });
  each("helix angle (right hand > 0)", angle, [&](std::size_t i) { return paper_helix(design.cut_helix(i), design.cone[i]); });
  for (const std::size_t i : both_wheels) {
    if (!is_worm(design, i)) continue;
    const double lead_angle = std::numbers::pi / 2 - std::abs(design.helix[i]);
    const std::string of = std::string(" of worm ") + name_of(i);
    put("lead angle" + of, lead_angle, angle);
    put("lead" + of, 2 * std::numbers::pi * design.radius(i) * std::tan(lead_angle), length);
    put("diameter quotient" + of, design.teeth[i] / std::tan(lead_angle), none);
    put("self-locking at friction coefficients of at least", std::cos(design.pressure_angle) * std::tan(lead_angle), none);
  }

  const Vec3 a = frames.contact - design.radius(0) * frames.mu.col(1), b = frames.contact - design.radius(1) * frames.xi.col(1);
  vector("centre of wheel B", b, length);
  vector("axle of wheel B", frames.xi.col(0), none);
  vector("contact point", frames.contact, length);
  put("distance of the centres", (b - a).norm(), length);
  put("angle between the axles", std::atan2(std::hypot(Z(1, 0), Z(2, 0)), std::abs(Z(0, 0))), angle);
  put("distance of the axles", axle_distance(design, Z), length);

  put("ratio z_B/z_A", static_cast<double>(design.teeth[1]) / design.teeth[0], none);
  put("teeth met per turn of wheel A", design.teeth[0], none);
  put("turns of A until the same teeth meet", hunting_period(design.teeth), none);
  if (const auto ratio = contact_ratio(design)) {
    put(kind != 0 ? "transverse contact ratio" : "contact ratio of the virtual wheels", *ratio, none);
    if (width > 0 && design.helix[0] != 0) {
      const double overlap = width * std::sin(std::abs(design.helix[0])) / (std::numbers::pi * design.normal_module);
      put("overlap ratio", overlap, none);
      put("total contact ratio", *ratio + overlap, none);
    }
  }
  if (teeth.stiffness > 0) {
    put("tooth stiffness", teeth.stiffness, stiffness);
    if (teeth.iso.mesh > 0) {
      put("stiffness of one pair of teeth per face width, c'", teeth.iso.single, pressure);
      put("mesh stiffness per face width, c_gamma", teeth.iso.mesh, pressure);
    }
    put("tooth damping", teeth.damping, damping);
    put_backlash(list, teeth, design.pressure_angle);
    if (teeth.backlash > 0) put("rounding width of the contact law (SMOOTH)", teeth.onset, length);
  }
  if (std::abs(teeth.mesh.phase) > 1e-9) put("phase of the mesh, of a tooth of 360 degrees", teeth.mesh.phase, angle);
  if (teeth.mesh.misfit != 0) put("misfit of the teeth along the circumference", teeth.mesh.misfit, length);
  return list;
}

namespace {

/// Whether an earlier pair of the deck has the same teeth, so that its warnings cover this one.
bool said_before(const GearData& data, const BuildContext& context) {
  if (!context.records) return false;
  for (const deck::Record& record : *context.records) {
    if (&record == &context.record) return false;
    const auto* other = record.get<GearData>();
    if (other && other->teeth == data.teeth && other->starts == data.starts && other->pressure_angle == data.pressure_angle &&
        other->helix == data.helix && other->cone == data.cone && other->shaft_angle == data.shaft_angle &&
        other->internal == data.internal && other->kind.tag == data.kind.tag &&
        static_cast<const CutData&>(*other) == static_cast<const CutData&>(data) && data.shift.size() != 1)
      return true;
  }
  return false;
}

}  // namespace

void warn_about_undercut(const GearDesign& design, std::size_t wheel, const std::string& who, const BuildContext& context) {
  const double z = virtual_teeth(design, wheel), least = least_teeth(design, wheel);
  if (z >= least * (1 - 1e-9)) return;
  const bool cone = std::abs(std::sin(design.cone[wheel])) > 1e-9;
  context.diagnostics.warning(
      context.record.where("Z"),
      fmt::format("{} of {} teeth{} is undercut: its teeth are full from {:.0f}{} on", who, design.teeth[wheel],
                  cone ? fmt::format(" ({:.3g} virtual)", z) : "", std::ceil(least * (1 - 1e-9)), cone ? " virtual" : ""),
      cone ? "take more teeth, a larger ALPHA or HELIX; real bevel wheels of so few teeth have profile shift, which is not part "
             "of "
             "the model"
           : fmt::format("take more teeth, a larger ALPHA or HELIX, or a profile shift: X {:.3f} or more", 1 - z / least));
}

void warn_about_contact_ratio(double usable, const BuildContext& context) {
  if (usable >= 1) return;
  context.diagnostics.warning(
      context.record.where("Z"),
      usable > 0 ? fmt::format("contact ratio {:.3g}, undercut considered: at times no teeth would touch", usable)
                 : "contact ratio 0, undercut considered: no teeth would touch",
      "take more teeth; the model passes the motion on all the same");
}

void warn_about_teeth(const GearDesign& design, const GearData& data, const BuildContext& context) {
  if (said_before(data, context)) return;
  const auto warn = [&](const char* keyword, std::string message, std::string cure) {
    context.diagnostics.warning(context.record.where(keyword), std::move(message), std::move(cure));
  };
  if (design.cut) warn_about_cut(*design.cut, data, {"wheel A", "wheel B"}, context);
  for (const std::size_t i : both_wheels)
    if (!is_ring(design, i) && !design.cut) warn_about_undercut(design, i, fmt::format("wheel {}", name_of(i)), context);
  if (!design.cut && design.parallel_kind() != 0) warn_about_plain_tips(design, {"wheel A", "wheel B"}, context);
  const bool internal = design.parallel_kind() < 0;
  const auto clearance = internal_clearance(design);
  if (internal && !clearance)
    warn("Z", "the ring's teeth reach inside its base circle, where there is no involute",
         "take more teeth on the ring, or a larger ALPHA");
  if (clearance && clearance->involute < 0)
    warn("Z", "the tips of the ring gear touch the pinion below its base circle (involute interference)",
         "take more teeth on the pinion, or a larger ALPHA");
  if (clearance && clearance->tips < 0)
    warn("Z",
         fmt::format("the tips of pinion and ring gear strike each other: {} teeth differ too little from {}",
                     std::min(design.teeth[0], design.teeth[1]), std::max(design.teeth[0], design.teeth[1])),
         "take a larger difference, a larger ALPHA or stub teeth");
  if (const auto ratio = usable_contact_ratio(design)) warn_about_contact_ratio(*ratio, context);
}

}  // namespace engrane::elements::gears
