// SPDX-License-Identifier: BSD-3-Clause
#include "elements/gears/cut_card.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string_view>
#include <utility>

#include "elements/common/building.hpp"

namespace engrane::elements::gears {

namespace {

/// A single value applies to both wheels.
std::array<double, 2> both(const std::vector<double>& values, double otherwise) {
  if (values.empty()) return {otherwise, otherwise};
  return {values.front(), values.back()};
}

/// The keyword that decides where the tips are and how thick, to which messages about them point.
const char* tip_keyword(const CutData& data) {
  if (!data.tip_diameter.empty()) return "TIP";
  if (!data.shift.empty()) return "X";
  if (!data.tip_alteration.empty()) return "TIPALTER";
  return data.addendum.empty() ? "Z" : "ADDENDUM";
}

/// What makes tips thicker, beside smaller tip diameters.
const char* thicker_with(const CutData& data) { return data.shift.empty() ? "more teeth, a smaller ALPHA" : "a smaller X"; }

/// Reports an error for teeth that do not reach each other.
bool check_overlap(const CutTeeth& cut, const CutData& data, const std::array<std::string, 2>& names,
                   const BuildContext& context) {
  constexpr double rounding = 1e-9;
  const double overlap = cut.tip_overlap();
  if (overlap > rounding * cut.normal_module) return true;
  const bool external = cut.teeth[1] != 0 && !cut.ring[0] && !cut.ring[1];
  context.error(tip_keyword(data),
                fmt::format("the teeth of {} and {} do not reach each other: {}", names[0], names[1],
                            external ? fmt::format("tip radii of {} and {} at a centre distance of {}", number(cut.tip[0]),
                                                   number(cut.tip[1]), number(cut.distance()))
                                     : fmt::format("their tips are {} apart", number(-overlap))),
                fmt::format("their tips must overlap, usually by two modules, {}", number(2 * cut.normal_module)));
  return false;
}

void warn_about_thin_tips(const CutTeeth& cut, const CutData& data, const std::array<std::string, 2>& names,
                          const BuildContext& context) {
  constexpr double least_tip = 0.2;  // DIN 3960, 3.9: s_an in modules
  for (const std::size_t i : both_wheels)
    if (cut.teeth[i] != 0 && !cut.ring[i] && cut.tip_thickness(i) < least_tip * cut.normal_module)
      context.diagnostics.warning(context.record.where(tip_keyword(data)),
                                  fmt::format("the tips of {} are {:.3g} modules thick, less than {}", names[i],
                                              cut.tip_thickness(i) / cut.normal_module, least_tip),
                                  fmt::format("take {}, or a smaller tip diameter with TIP", thicker_with(data)));
}

}  // namespace

std::vector<std::pair<std::string_view, bool>> given_cut_keywords(const CutData& data) {
  return {{"X", !data.shift.empty()},
          {"ADDENDUM", !data.addendum.empty()},
          {"DEDENDUM", !data.dedendum.empty()},
          {"TIP", !data.tip_diameter.empty()},
          {"TIPALTER", !data.tip_alteration.empty()}};
}

CutTeeth reference_cut(const GearDesign& reference, const CutData& data) {
  CutTeeth cut;
  cut.teeth = reference.teeth;
  cut.ring = {std::cos(reference.cone[0]) < 0, std::cos(reference.cone[1]) < 0};
  cut.normal_module = reference.normal_module;
  cut.pressure_angle = reference.pressure_angle;
  cut.helix = reference.helix;
  for (std::size_t i = 0; i < data.shift.size(); ++i) cut.shift[i] = data.shift[i];
  cut.addendum = both(data.addendum, 1);
  cut.dedendum = both(data.dedendum, 1.25);
  cut.working_pressure_angle = cut.transverse_pressure_angle();
  return cut;
}

bool set_tips(CutTeeth& cut, const CutData& data, const std::array<std::string, 2>& names, const BuildContext& context) {
  const bool rack = cut.teeth[1] == 0;
  if (!data.tip_diameter.empty() && !data.tip_alteration.empty()) {
    context.error("TIPALTER", "TIP and TIPALTER both fix the tip circles", "keep one of them");
    return false;
  }
  cut.set_tips(both(data.tip_alteration, cut.clearance_alteration()));
  if (!data.tip_diameter.empty()) {
    const std::size_t needed = rack ? 1 : 2;
    if (data.tip_diameter.size() != needed) {
      context.error("TIP", fmt::format("{} tip diameters are needed, {} given", needed, data.tip_diameter.size()),
                    "give those of A and of B");
      return false;
    }
    for (std::size_t i = 0; i < needed; ++i) cut.tip[i] = 0.5 * data.tip_diameter[i];
  }
  bool good = true;
  const char* const keyword = tip_keyword(data);
  for (const std::size_t i : both_wheels) {
    if (cut.teeth[i] == 0) continue;
    const double root = cut.root_radius(i), side = cut.ring[i] ? -1 : 1;
    if (side * (cut.tip[i] - root) <= 0) {
      context.error(keyword,
                    fmt::format("{}: tip diameter {} {} root diameter {}", names[i], number(2 * cut.tip[i]),
                                side > 0 ? "within the" : "outside the", number(2 * root)),
                    fmt::format("without shift its teeth reach from {} to {}",
                                number(2 * (cut.reference_radius(i) - side * cut.normal_module * cut.dedendum[i])),
                                number(2 * (cut.reference_radius(i) + side * cut.normal_module * cut.addendum[i]))));
      good = false;
      continue;
    }
    if (cut.ring[i] || cut.tip_thickness(i) > 0) continue;
    // diameter at which the flanks meet, by bisection between the reference circle and the tip
    double low = std::min(cut.reference_radius(i), cut.tip[i]), high = cut.tip[i];
    for (int k = 0; k < 100; ++k) {
      const double middle = 0.5 * (low + high);
      (cut.thickness_at(i, middle) > 0 ? low : high) = middle;
    }
    context.error(keyword,
                  fmt::format("{}: its teeth are pointed at the diameter {}, below the tip diameter {}", names[i],
                              number(2 * low), number(2 * cut.tip[i])),
                  fmt::format("take {}, a smaller ADDENDUM or a smaller tip diameter with TIP", thicker_with(data)));
    good = false;
  }
  return good && check_overlap(cut, data, names, context);
}

bool check_plain_tips(const GearDesign& design, const std::array<std::string, 2>& names, const BuildContext& context) {
  const CutData none;
  CutTeeth cut = reference_cut(design, none);
  return set_tips(cut, none, names, context);
}

void warn_about_plain_tips(const GearDesign& design, const std::array<std::string, 2>& names, const BuildContext& context) {
  const CutData none;
  CutTeeth cut = reference_cut(design, none);
  cut.set_tips({0, 0});
  warn_about_thin_tips(cut, none, names, context);
}

void warn_about_cut(const CutTeeth& cut, const CutData& data, const std::array<std::string, 2>& names,
                    const BuildContext& context) {
  const auto warn = [&](std::string_view keyword, std::string message, std::string cure) {
    context.diagnostics.warning(context.record.where(keyword), std::move(message), std::move(cure));
  };
  const char* keyword = data.shift.empty() ? "Z" : "X";
  warn_about_thin_tips(cut, data, names, context);
  for (const std::size_t i : both_wheels) {
    if (cut.teeth[i] == 0) continue;
    const double least = cut.least_shift(i);
    if (!cut.ring[i] && cut.shift[i] < least - 1e-6)
      warn(keyword,
           fmt::format("{} of {} teeth is undercut: its teeth are full from a profile shift of {:.3g} on, {} given", names[i],
                       cut.teeth[i], least, number(cut.shift[i])),
           "take a larger X, more teeth, or a larger ALPHA or HELIX");
    if (cut.without_involute(i))
      warn(tip_keyword(data),
           fmt::format("{}: its tip diameter {} is within its base circle, {}, so that no part of its flanks is an involute: "
                       "contact ratio 0, no teeth would touch",
                       names[i], number(2 * cut.tip[i]), number(2 * cut.base_radius(i))),
           "take a larger tip diameter; the model passes the motion on all the same");
    if (cut.teeth[1 - i] == 0) continue;
    if (const double clearance = cut.tip_clearance(i); clearance < 0)
      warn(data.tip_diameter.empty() ? keyword : "TIP",
           fmt::format("the tips of {} run into the roots of {} by {}", names[i], names[1 - i], number(-clearance)),
           fmt::format("a tip diameter of {} leaves a clearance of {}",
                       number(2 * (cut.tip[i] + (cut.ring[i] ? -1 : 1) *
                                                    (clearance - cut.normal_module * (cut.dedendum[1 - i] - cut.addendum[i])))),
                       number(cut.normal_module * (cut.dedendum[1 - i] - cut.addendum[i]))));
  }
}

}  // namespace engrane::elements::gears
