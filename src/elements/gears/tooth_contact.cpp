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

std::vector<SwitchNames> ToothContact::switch_names() const {
  std::vector<SwitchNames> list;
  if (!elastic() || law_.backlash == 0 || options_.slices > 1 || law_.relief.active()) return list;
  for (const char* side : {"front", "back"}) {
    const std::string flank = side + std::string(" flank");
    list.push_back({flank + " touches", flank + " parts"});
    if (law_.onset > 0) list.push_back({flank + " is in full contact", flank + " begins to part"});
    if (!limits_damping()) continue;
    list.push_back({flank + " damps in full", flank + " damps no more than it may"});
    list.push_back({flank + " presses again", flank + " presses no more"});
  }
  return list;
}

double ToothContact::size_of_gap(const ContactReport& report, const State& state) const {
  // u_m is a difference of angles that are known to the rounding error of a radian
  return geometry_.radius + law_.backlash + std::abs(state.scalars[2]) + std::abs(report.approach - state.scalars[2]);
}

bool ToothContact::touches(const ContactReport& report, const State& state) const {
  const double half = 0.5 * law_.onset, size = size_of_gap(report, state);
  return Switch{report.front + half, 0, size}.unclear() || Switch{report.back + half, 0, size}.unclear();
}

void ToothContact::switches(const ContactReport& report, const State& state, std::span<Switch> values) const {
  const Function::Jet error_a = law_.error.of_a(state.scalars[0], law_.mesh),
                      error_b = law_.error.of_b(state.scalars[1], law_.mesh);
  const double turn_a = state.scalar_rates[0], turn_b = state.scalar_rates[1];
  const double rate = state.scalar_rates[2] + error_a.d1 * turn_a + error_b.d1 * turn_b;
  const double acceleration = state.scalar_accelerations[2] + error_a.d1 * state.scalar_accelerations[0] +
                              error_b.d1 * state.scalar_accelerations[1] + error_a.d2 * turn_a * turn_a +
                              error_b.d2 * turn_b * turn_b;
  const double half = 0.5 * law_.onset, size = size_of_gap(report, state);
  std::size_t next = 0;
  for (const double sign : {1.0, -1.0}) {
    const double pressed = sign > 0 ? report.front : report.back, speed = sign * rate;
    values[next++] = {pressed + half, speed, size};
    if (half > 0) values[next++] = {pressed - half, speed, size};
    if (!limits_damping()) continue;
    const double k = report.stiffness_factor * law_.stiffness;
    const Function::Jet flank = law_.flank(pressed);
    const double damper = law_.damping * speed, change = sign * law_.damping * acceleration;
    for (const double part : {1 - ToothLaw::limit_rounding, 1 + ToothLaw::limit_rounding})
      values[next++] = pressed > half ? Switch{part * k * flank.f + damper, part * k * flank.d1 * speed + change,
                                               k * pressed + std::abs(damper)}
                                      : Switch{};
  }
}

}  // namespace engrane::elements::gears
