// SPDX-License-Identifier: BSD-3-Clause
#include "elements/gears/mesh_stiffness.hpp"

#include <cmath>

#include "math/angle.hpp"

namespace engrane::elements::gears {

namespace {}  // namespace

Function::Jet smooth_step(double x, double width) {
  if (x <= -0.5 * width) return {};
  if (x >= 0.5 * width) return {1, 0, 0, 0};
  const double t = x / width + 0.5, w = 1 / width;
  return {t * t * t * (10 + t * (6 * t - 15)), 30 * w * t * t * (1 - t) * (1 - t), 60 * w * w * t * (1 - t) * (1 - 2 * t),
          60 * w * w * w * (1 + 6 * t * (t - 1))};
}

Function::Jet fourier_series(const std::vector<double>& coefficients, double angle) {
  Function::Jet sum;
  for (std::size_t i = 0; i + 1 < coefficients.size(); i += 2) {
    const double n = static_cast<double>(i / 2) + 1, c = std::cos(n * angle), s = std::sin(n * angle);
    const double even = coefficients[i] * c + coefficients[i + 1] * s, odd = coefficients[i + 1] * c - coefficients[i] * s;
    sum.f += even;
    sum.d1 += n * odd;
    sum.d2 -= n * n * even;
    sum.d3 -= n * n * n * odd;
  }
  return sum;
}

Function::Jet MeshStiffness::square_wave(double cycle) const {
  // One more pair for the fraction of the pitch by which the contact ratio exceeds an integer. In the middle of that interval
  // two flanks touch half a base pitch on either side of the pitch point.
  const double pairs = std::floor(contact_ratio), fraction = contact_ratio - pairs;
  const double from_middle = cycle - middle - std::round(cycle - middle);
  const double side = from_middle < 0 ? -1 : 1;
  const Function::Jet s = smooth_step(0.5 * fraction - std::abs(from_middle), edge);
  const double step = 1 / contact_ratio;
  return {step * (pairs + s.f), -side * step * s.d1, step * s.d2, -side * step * s.d3};
}

Function::Jet MeshStiffness::at(double phase) const {
  switch (kind) {
    case Kind::constant:
      return {1, 0, 0, 0};
    case Kind::fourier: {
      Function::Jet k = fourier_series(coefficients, phase);
      k.f += 1;
      return k;
    }
    case Kind::table:
      return stretched(function->at(phase / whole_turn), 1 / whole_turn);
    case Kind::user: {
      const user::Results y = at(phase, 0);
      return {y[0], y[1], y[2], 0};
    }
    case Kind::square:
      return stretched(square_wave(phase / whole_turn), 1 / whole_turn);
  }
  return {1, 0, 0, 0};
}

user::Results MeshStiffness::at(double phase, double deflection) const {
  const double cycle = phase / whole_turn;
  user::Results y = routine->at({cycle - std::floor(cycle), deflection, 0});
  y[1] /= whole_turn;
  y[2] /= whole_turn * whole_turn;
  return y;
}

IsoStiffness iso_stiffness(const IsoMesh& mesh) {
  constexpr double steel = 206;  // N/(mm µm): 206 000 N/mm²
  const double cos_beta = std::cos(mesh.helix);
  const auto inverse_teeth = [&](std::size_t wheel) {
    return mesh.ring[wheel] ? 0.0 : cos_beta * cos_beta * cos_beta / mesh.teeth[wheel];
  };
  // wheel 1 of the standard is the pinion
  const std::size_t pinion = mesh.ring[0] || (!mesh.ring[1] && mesh.teeth[1] < mesh.teeth[0]) ? 1 : 0, wheel = 1 - pinion;
  const double n_1 = inverse_teeth(pinion), n_2 = inverse_teeth(wheel);
  const double x_1 = mesh.ring[pinion] ? 0 : mesh.shift[pinion], x_2 = mesh.ring[wheel] ? 0 : mesh.shift[wheel];
  const double compliance = 0.04723 + 0.15551 * n_1 + 0.25791 * n_2 - 0.00635 * x_1 - 0.11654 * x_1 * n_1 - 0.00193 * x_2 -
                            0.24188 * x_2 * n_2 + 0.00529 * x_1 * x_1 + 0.00182 * x_2 * x_2;
  const double dedendum = 0.5 * (mesh.dedendum[0] + mesh.dedendum[1]);
  const double rack = (1 + 0.5 * (1.2 - dedendum)) * (1 - 0.02 * (20 - mesh.pressure_angle / degree));
  const double modulus = 2 * mesh.E[0] * mesh.E[1] / (mesh.E[0] + mesh.E[1]) / steel;
  IsoStiffness c;
  c.single = modulus * 0.8 * rack * cos_beta / compliance;
  c.mesh = c.single * (0.75 * mesh.contact_ratio + 0.25);
  return c;
}

double iso_mesh_stiffness(const IsoMesh& mesh) {
  const double helix = mesh.working_helix.value_or(mesh.helix);
  const double angle = mesh.working_pressure_angle.value_or(std::atan(std::tan(mesh.pressure_angle) / std::cos(mesh.helix)));
  const double along = std::cos(angle) / std::cos(helix);
  return iso_stiffness(mesh).mesh * mesh.width * along * along;
}

}  // namespace engrane::elements::gears
