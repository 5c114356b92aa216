// SPDX-License-Identifier: BSD-3-Clause
#include "elements/gears/tooth_contact.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace engrane::elements::gears {

namespace {

/// Lower bound of the running pressure angle. It is zero when the base circles touch, and closer wheels have no involute
/// contact. Iterates beyond the bound use a parabolic continuation.
constexpr double least_pressure_angle = 0.05;

}  // namespace

double ContactGeometry::working_pressure_angle(double opening) const {
  if (base_radii == 0) return transverse_pressure_angle;
  const double distance = center_distance + side * opening, cosine = std::abs(base_radii) / distance;
  return distance > 0 && cosine < std::cos(least_pressure_angle) ? std::acos(cosine) : least_pressure_angle;
}

Function::Jet ContactGeometry::flank_opening(double opening) const {
  const double lead = std::cos(helix) / std::cos(transverse_pressure_angle);
  if (base_radii == 0) {
    const double slope = lead * std::sin(transverse_pressure_angle);
    return {slope * opening, slope, 0, 0};
  }
  const double closest = side * (std::abs(base_radii) / std::cos(least_pressure_angle) - center_distance);
  if (side * (opening - closest) < 0) {
    const Function::Jet end = flank_opening(closest);
    const double beyond = opening - closest;
    return {end.f + beyond * (end.d1 + 0.5 * beyond * end.d2), end.d1 + beyond * end.d2, end.d2, 0};
  }
  const double running = working_pressure_angle(opening), distance = center_distance + side * opening;
  const double c = std::cos(running), s = std::sin(running);
  const double turn = side * c / (distance * s);  // dα_t′/d opening
  const auto involute = [](double angle) { return std::tan(angle) - angle; };
  const double bend = -c / (distance * distance * s) * (1 + 1 / (s * s));  // second derivative of α_t′
  return {lead * base_radii * (involute(running) - involute(transverse_pressure_angle)), lead * s, lead * c * turn,
          lead * (c * bend - s * turn * turn)};
}

std::vector<std::string> ToothContact::remarks(double deflection, double opening) const {
  std::vector<std::string> list;
  // a flank pressed in by w/2 or more follows (28); up to four widths the rounding still shows in the peaks
  if (deflection > 0 && deflection < 4 * law_.onset)
    list.push_back(
        fmt::format("the teeth were pressed in by {:.3g} at most, and SMOOTH lets contact come on over {:.3g}: such a light load "
                    "follows the rounded onset, not KM; leave SMOOTH out, or give {:.1g}",
                    deflection, law_.onset, 0.01 * deflection));
  if (opening > geometry_.reach)
    list.push_back(fmt::format(
        "the wheels moved apart by {:.3g}, and their teeth overlap by only {:.3g}: they were out of mesh, which this element "
        "does not model. It went on to transmit forces, and results since then are wrong; make the supports stiffer or hold "
        "the wheels at their distance",
        opening, geometry_.reach));
  return list;
}

}  // namespace engrane::elements::gears
