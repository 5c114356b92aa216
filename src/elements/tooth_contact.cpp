// SPDX-License-Identifier: BSD-3-Clause
#include "elements/tooth_contact.hpp"

namespace engrane {

double ContactGeometry::working_pressure_angle(double opening) const {
  if (base_radii == 0) return transverse_pressure_angle;
  const double cosine = std::abs(base_radii) / (center_distance + side * opening);
  return cosine > 0 && cosine <= 1 ? std::acos(cosine) : std::numeric_limits<double>::quiet_NaN();
}

Function::Jet ContactGeometry::flank_opening(double opening) const {
  const double lead = std::cos(helix) / std::cos(transverse_pressure_angle);
  if (base_radii == 0) {
    const double slope = lead * std::sin(transverse_pressure_angle);
    return {slope * opening, slope, 0, 0};
  }
  const double running = working_pressure_angle(opening), distance = center_distance + side * opening;
  const double c = std::cos(running), s = std::sin(running);
  const double turn = side * c / (distance * s);  // dα_t′/d opening
  const auto involute = [](double angle) { return std::tan(angle) - angle; };
  const double bend = -c / (distance * distance * s) * (1 + 1 / (s * s));  // of α_t′
  return {lead * base_radii * (involute(running) - involute(transverse_pressure_angle)), lead * s, lead * c * turn,
          lead * (c * bend - s * turn * turn)};
}

}  // namespace engrane
