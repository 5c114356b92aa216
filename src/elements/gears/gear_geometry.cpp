// SPDX-License-Identifier: BSD-3-Clause
#include "elements/gears/gear_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace engrane::elements::gears {

namespace {

/// Sines and cosines below this count as zero, since angles are typed in degrees.
constexpr double angular_rounding = 1e-9;

}  // namespace

double GearDesign::radius(std::size_t wheel) const { return lever(wheel) / std::cos(helix[wheel]); }

double GearDesign::transverse_module(std::size_t wheel) const { return normal_module / std::cos(helix[wheel]); }

double GearDesign::transverse_pressure_angle(std::size_t wheel) const {
  return std::atan(std::tan(pressure_angle) / std::cos(helix[wheel]));
}

int GearDesign::parallel_kind() const {
  if (std::abs(helix[0] + helix[1]) > angular_rounding) return 0;
  if (std::abs(std::sin(cone[0])) > angular_rounding || std::abs(std::sin(cone[1])) > angular_rounding) return 0;
  if (std::cos(cone[0]) < 0) return -2;
  return std::cos(cone[1]) < 0 ? -1 : 1;
}

double paper_helix(double trade, double cone) { return std::cos(cone) < -angular_rounding ? trade : -trade; }

Mat3 tooth_axes(double cone, double helix) {
  const double cg = std::cos(cone), sg = std::sin(cone), cb = std::cos(helix), sb = std::sin(helix);
  Mat3 Y;
  Y << cg * cb, -sg, cg * sb,  //
      sg * cb, cg, sg * sb,    //
      -sb, 0, cb;
  return Y;
}

Mat3 mating_tooth_axes(double cone, double helix) { return tooth_axes(cone, helix) * Vec3(1, -1, -1).asDiagonal(); }

Mat3 wheel_to_wheel(const GearDesign& design) {
  return tooth_axes(design.cone[0], design.helix[0]) * mating_tooth_axes(design.cone[1], design.helix[1]).transpose();
}

double Closure::misfit() const {
  return std::max(std::abs(offset_given - offset_needed), std::abs(distance_given - distance_needed)) / size;
}

Closure closure(const GearDesign& design, const Vec3& x_a, const Vec3& x_b, const Vec3& axle) {
  const Mat3 Z = wheel_to_wheel(design);
  const double r_a = design.radius(0), r_b = design.radius(1);
  const Vec3 x_ab = x_b - x_a;
  Closure c;
  c.offset_given = x_ab.dot(axle);
  c.offset_needed = -r_b * Z(0, 1);
  c.distance_given = cross(axle, x_ab).norm();
  c.distance_needed = std::hypot(r_a - Z(1, 1) * r_b, r_b * Z(2, 1));
  c.size = r_a + r_b;
  return c;
}

PitchFrames pitch_frames(const GearDesign& design, const Vec3& x_a, const Vec3& x_b, const Vec3& axle) {
  const Mat3 Z = wheel_to_wheel(design);
  const double r_a = design.radius(0), r_b = design.radius(1);
  const double a = r_a - Z(1, 1) * r_b, b = r_b * Z(2, 1);
  Vec3 w = x_b - x_a + r_b * Z(0, 1) * axle;
  w -= w.dot(axle) * axle;
  PitchFrames f;
  f.mu.col(0) = axle;
  f.mu.col(1) = (a * w + b * cross(axle, w)).normalized();
  f.mu.col(2) = cross(axle, Vec3(f.mu.col(1)));
  f.xi = f.mu * Z;
  f.contact = 0.5 * (x_a + r_a * f.mu.col(1) + x_b + r_b * f.xi.col(1));
  return f;
}

Vec3 centre_of_second_wheel(const GearDesign& design, const Vec3& x_a, const Vec3& axle, const Vec3& toward) {
  const Vec3 xi_2 = wheel_to_wheel(design).col(1);  // in the components of μ
  const Vec3 across = cross(axle, toward);
  return x_a + design.radius(0) * toward - design.radius(1) * (xi_2[0] * axle + xi_2[1] * toward + xi_2[2] * across);
}

std::array<double, 2> cones_of_shaft_angle(double shaft, const std::array<int, 2>& teeth) {
  const double s = std::sin(shaft), c = std::cos(shaft);
  const double ratio = static_cast<double>(teeth[1]) / teeth[0];
  return {std::atan2(s, ratio + c), std::atan2(s, 1 / ratio + c)};
}

std::optional<double> shaft_angle_of_axles(const Vec3& x_a, const Vec3& axle_a, const Vec3& x_b, const Vec3& axle_b) {
  const Vec3 normal = cross(axle_a, axle_b), x_ab = x_b - x_a;
  const double sine2 = normal.squaredNorm();
  if (sine2 < angular_rounding) return {};
  const double size = x_ab.norm();
  if (std::abs(x_ab.dot(normal)) > 1e-6 * size * std::sqrt(sine2)) return {};
  const double s = cross(x_ab, axle_b).dot(normal) / sine2;  // the axles meet at x_a + s axle_a = x_b + t axle_b
  const double t = cross(x_ab, axle_a).dot(normal) / sine2;
  if (std::min(std::abs(s), std::abs(t)) < 1e-6 * size) return {};
  return std::acos(std::clamp((s * t > 0 ? 1 : -1) * axle_a.dot(axle_b), -1.0, 1.0));
}

double tip_radius(const GearDesign& design, std::size_t wheel) {
  if (design.cut) return design.cut->tip[wheel];
  return design.radius(wheel) + design.normal_module * std::cos(design.cone[wheel]);
}

GearDesign working_design(const GearDesign& reference, const CutTeeth& cut) {
  GearDesign design = reference;
  const double widening = std::cos(cut.transverse_pressure_angle()) / std::cos(cut.working_pressure_angle);  // r_w/r
  for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) design.helix[i] = std::atan(widening * std::tan(cut.helix[i]));
  const double cosine = std::cos(design.helix[0]);
  design.normal_module = cut.transverse_module() * widening * cosine;
  design.pressure_angle = std::atan(std::tan(cut.working_pressure_angle) * cosine);
  design.cut = cut;
  return design;
}

std::optional<double> virtual_path_of_contact(const GearDesign& design, std::size_t wheel) {
  const double alpha = design.transverse_pressure_angle(wheel), m_n = design.normal_module, cosine = std::cos(design.cone[wheel]);
  if (std::abs(cosine) < angular_rounding) return m_n / std::sin(alpha);  // crown wheel: its virtual wheel is a rack
  const double r = design.radius(wheel) / std::abs(cosine), base = r * std::cos(alpha);
  const double tip = design.cut ? design.cut->tip[wheel] : cosine < 0 ? r - m_n : r + m_n;
  if (tip <= base) return {};  // the tip of a ring inside its base circle: no involute there
  const double side = std::sqrt(tip * tip - base * base) - r * std::sin(alpha);
  return cosine < 0 ? -side : side;
}

std::optional<double> path_of_contact(const GearDesign& design, std::size_t wheel) {
  if (design.parallel_kind() == 0) return {};
  return virtual_path_of_contact(design, wheel);
}

std::optional<double> contact_ratio(const GearDesign& design) {
  if (std::abs(design.helix[0] + design.helix[1]) > angular_rounding) return {};  // skew axles
  const auto a = virtual_path_of_contact(design, 0), b = virtual_path_of_contact(design, 1);
  if (!a || !b) return {};
  return (*a + *b) / (std::numbers::pi * design.transverse_module(0) * std::cos(design.transverse_pressure_angle(0)));
}

}  // namespace engrane::elements::gears
