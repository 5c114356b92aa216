// SPDX-License-Identifier: BSD-3-Clause
#include "elements/gears/profile_shift.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace engrane::elements::gears {

double involute(double angle) { return std::tan(angle) - angle; }

double inverse_involute(double value) {
  if (!(value > 0)) return 0;
  // initial guesses: inv α = α³/3 (1 + 2α²/5 + …) for small values, tanα ≈ inv α + π/2 for large ones; Newton with inv′ = tan²α
  double angle = value < 1 ? std::cbrt(3 * value) / (1 + 0.2 * std::pow(3 * value, 2.0 / 3.0)) : std::atan(value + 1.4);
  for (int i = 0; i < 60; ++i) {
    const double tangent = std::tan(angle), step = (tangent - angle - value) / (tangent * tangent);
    const double next = std::clamp(angle - step, 0.3 * angle, 0.5 * (angle + 0.5 * std::numbers::pi));
    if (std::abs(next - angle) <= 1e-16 * angle) break;
    angle = next;
  }
  return angle;
}

double CutTeeth::transverse_module() const { return normal_module / std::cos(helix[0]); }

double CutTeeth::transverse_pressure_angle() const { return std::atan(std::tan(pressure_angle) / std::cos(helix[0])); }

double CutTeeth::reference_radius(std::size_t wheel) const { return 0.5 * teeth[wheel] * transverse_module(); }

double CutTeeth::base_radius(std::size_t wheel) const { return reference_radius(wheel) * std::cos(transverse_pressure_angle()); }

double CutTeeth::working_radius(std::size_t wheel) const { return base_radius(wheel) / std::cos(working_pressure_angle); }

double CutTeeth::root_radius(std::size_t wheel) const {
  return reference_radius(wheel) - outward(wheel) * normal_module * (dedendum[wheel] - shift[wheel]);
}

double CutTeeth::reference_distance() const { return 0.5 * std::abs(teeth_sum()) * transverse_module(); }

double CutTeeth::distance() const {
  return reference_distance() * std::cos(transverse_pressure_angle()) / std::cos(working_pressure_angle);
}

double CutTeeth::thickness(std::size_t wheel) const {
  return normal_module * (0.5 * std::numbers::pi + 2 * shift[wheel] * std::tan(pressure_angle));
}

double CutTeeth::thickness_at(std::size_t wheel, double radius) const {
  const double r = reference_radius(wheel), cosine = base_radius(wheel) / radius;
  const double half_angle = 0.5 * thickness(wheel) / (std::cos(helix[0]) * r);
  const double change = involute(transverse_pressure_angle()) - (cosine < 1 ? involute(std::acos(cosine)) : 0);
  return 2 * radius * (half_angle + outward(wheel) * change);
}

double CutTeeth::tip_thickness(std::size_t wheel) const {
  const double helix_there = std::atan(std::tan(helix[0]) * tip[wheel] / reference_radius(wheel));
  return thickness_at(wheel, tip[wheel]) * std::cos(helix_there);
}

double CutTeeth::tip_clearance(std::size_t wheel) const {
  const std::size_t mate = 1 - wheel;
  if (ring[wheel]) return tip[wheel] - distance() - root_radius(mate);
  if (ring[mate]) return root_radius(mate) - distance() - tip[wheel];
  return distance() - tip[wheel] - root_radius(mate);
}

double CutTeeth::tip_overlap() const {
  if (teeth[1] == 0) return tip[0] - reference_radius(0) + normal_module * (addendum[1] - shift[0]);
  if (ring[0]) return distance() + tip[1] - tip[0];
  if (ring[1]) return distance() + tip[0] - tip[1];
  return tip[0] + tip[1] - distance();
}

bool CutTeeth::without_involute(std::size_t wheel) const {
  return teeth[wheel] != 0 && !ring[wheel] && tip[wheel] <= base_radius(wheel);
}

double CutTeeth::tip_alteration(std::size_t wheel) const {
  return outward(wheel) * (tip[wheel] - reference_radius(wheel)) / normal_module - addendum[wheel] - shift[wheel];
}

double CutTeeth::least_shift(std::size_t wheel) const {
  const double sine = std::sin(transverse_pressure_angle());
  return dedendum[wheel] - 0.25 - teeth[wheel] * sine * sine / (2 * std::cos(helix[0]));
}

double CutTeeth::clearance_alteration() const {
  if (ring[0] || ring[1] || teeth[1] == 0) return 0;
  return (distance() - reference_distance()) / normal_module - shift[0] - shift[1];
}

void CutTeeth::set_tips(const std::array<double, 2>& k) {
  for (const std::size_t i : {std::size_t{0}, std::size_t{1}})
    tip[i] = reference_radius(i) + outward(i) * normal_module * (addendum[i] + shift[i] + k[i]);
}

std::optional<double> CutTeeth::working_angle_of(double sum_of_shifts) const {
  const double value = involute(transverse_pressure_angle()) + 2 * sum_of_shifts * std::tan(pressure_angle) / teeth_sum();
  if (!(value > 0)) return {};
  return inverse_involute(value);
}

std::optional<double> CutTeeth::working_angle_at(double distance) const {
  const double cosine = reference_distance() * std::cos(transverse_pressure_angle()) / distance;
  if (!(cosine > 0 && cosine < 1)) return {};
  return std::acos(cosine);
}

double CutTeeth::sum_of_shifts_at(double working_angle) const {
  return teeth_sum() * (involute(working_angle) - involute(transverse_pressure_angle())) / (2 * std::tan(pressure_angle));
}

}  // namespace engrane::elements::gears
