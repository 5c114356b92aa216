// SPDX-License-Identifier: BSD-3-Clause
#include "elements/gear_teeth.hpp"

#include <cmath>
#include <numbers>

namespace engrane {

namespace {

void add(Function::Jet& sum, const Function::Jet& term) {
  sum.f += term.f;
  sum.d1 += term.d1;
  sum.d2 += term.d2;
  sum.d3 += term.d3;
}

/// A function of degrees, with derivatives by radians.
Function::Jet by_radians(const Function& function, double angle) {
  constexpr double degrees = 180 / std::numbers::pi;
  return stretched(function.at(angle * degrees), degrees);
}

}  // namespace

Function::Jet TransmissionError::Wheel::at(double place) const {
  Function::Jet e;
  if (eccentricity != 0) {
    const double s = eccentricity * std::sin(place + phase), c = eccentricity * std::cos(place + phase);
    e = {s, c, -s, -c};
  }
  if (pitch) add(e, by_radians(*pitch, place));
  return e;
}

Function::Jet TransmissionError::of_b(double psi_b, const MeshPhase& mesh) const { return wheel[1].at(psi_b - mesh.contact[1]); }

Function::Jet TransmissionError::of_a(double psi_a, const MeshPhase& mesh) const {
  Function::Jet e = of_teeth(psi_a, mesh);
  add(e, wheel[0].at(psi_a - mesh.contact[0]));
  return e;
}

Function::Jet TransmissionError::of_teeth(double psi_a, const MeshPhase& mesh) const {
  const double z = teeth, tau = z * psi_a + mesh.phase;
  switch (kind) {
    case Kind::none:
      return {};
    case Kind::cosine: {
      const double s = std::sin(tau), c = std::cos(tau), X = amplitude;
      return {X * (1 - c), X * z * s, X * z * z * c, -X * z * z * z * s};
    }
    case Kind::fourier:
      return stretched(fourier_series(coefficients, tau), z);
    case Kind::table:
      return by_radians(*function, psi_a - mesh.contact[0]);
  }
  return {};
}

Function::Jet rounded_ramp(double x, double width) {
  if (x >= 0.5 * width) return {x, 1, 0, 0};
  if (x <= -0.5 * width) return {};
  const double t = x / width + 0.5;
  return {width * t * t * t * (1 - 0.5 * t), t * t * (3 - 2 * t), 6 * t * (1 - t) / width, (6 - 12 * t) / (width * width)};
}

double rounded_ramp_integral(double x, double width) {
  if (x <= -0.5 * width) return 0;
  if (x >= 0.5 * width) return 0.5 * x * x + width * width * 0.025;
  const double t = x / width + 0.5;
  return width * width * t * t * t * t * (0.25 - 0.1 * t);
}

Function::Jet ToothLaw::flank(double x) const {
  if (exponent == 1) return rounded_ramp(x, onset);
  if (x <= 0) return {};
  const double p = exponent, y = x / reference, power = std::pow(y, p - 2);
  return {reference * power * y * y, p * power * y, p * (p - 1) * power / reference,
          p * (p - 1) * (p - 2) * power / (y * reference * reference)};
}

double ToothLaw::flank_integral(double x) const {
  if (exponent == 1) return rounded_ramp_integral(x, onset);
  return x <= 0 ? 0 : reference * reference / (exponent + 1) * std::pow(x / reference, exponent + 1);
}

Function::Jet ToothLaw::deflection(double x) const {
  if (backlash == 0 && exponent == 1) return {x, 1, 0, 0};
  const Function::Jet front = flank(x), back = flank(-backlash - x);
  return {front.f - back.f, front.d1 + back.d1, front.d2 - back.d2, front.d3 + back.d3};
}

double ToothLaw::deflection_integral(double x) const {
  if (backlash == 0 && exponent == 1) return 0.5 * x * x;
  return flank_integral(x) + flank_integral(-backlash - x);
}

double tooth_damping(double ratio, double stiffness, double inertia_a, double inertia_b, double lever_a, double lever_b) {
  const double inverse_mass = lever_a * lever_a / inertia_a + lever_b * lever_b / inertia_b;
  return 2 * ratio * std::sqrt(stiffness / inverse_mass);
}

}  // namespace engrane
