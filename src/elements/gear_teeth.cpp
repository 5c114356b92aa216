// SPDX-License-Identifier: BSD-3-Clause
#include "elements/gear_teeth.hpp"

#include <cmath>
#include <numbers>

namespace engrane {

Function::Jet TransmissionError::at(double psi_a) const {
  const double z = teeth;
  switch (kind) {
    case Kind::none:
      return {};
    case Kind::cosine: {
      const double s = std::sin(z * psi_a), c = std::cos(z * psi_a), X = amplitude;
      return {X * (1 - c), X * z * s, X * z * z * c, -X * z * z * z * s};
    }
    case Kind::fourier: {
      Function::Jet e;
      for (std::size_t i = 0; i + 1 < coefficients.size(); i += 2) {
        const double w = z * (static_cast<double>(i / 2) + 1), s = std::sin(w * psi_a), c = std::cos(w * psi_a);
        const double even = coefficients[i] * c + coefficients[i + 1] * s, odd = coefficients[i + 1] * c - coefficients[i] * s;
        e.f += even;
        e.d1 += w * odd;
        e.d2 -= w * w * even;
        e.d3 -= w * w * w * odd;
      }
      return e;
    }
    case Kind::table: {
      constexpr double degrees = 180 / std::numbers::pi;
      Function::Jet e = function->at(psi_a * degrees);
      e.d1 *= degrees;
      e.d2 *= degrees * degrees;
      e.d3 *= degrees * degrees * degrees;
      return e;
    }
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

Function::Jet ToothLaw::deflection(double x) const {
  if (backlash == 0) return {x, 1, 0, 0};
  const Function::Jet front = rounded_ramp(x, onset), back = rounded_ramp(-backlash - x, onset);
  return {front.f - back.f, front.d1 + back.d1, front.d2 - back.d2, front.d3 + back.d3};
}

double ToothLaw::potential(double x) const {
  if (backlash == 0) return 0.5 * stiffness * x * x;
  return stiffness * (rounded_ramp_integral(x, onset) + rounded_ramp_integral(-backlash - x, onset));
}

int ToothLaw::contact(double x) const {
  if (x >= 0) return 1;
  return x <= -backlash ? -1 : 0;
}

double tooth_damping(double ratio, double stiffness, double inertia_a, double inertia_b, double lever_a, double lever_b) {
  const double inverse_mass = lever_a * lever_a / inertia_a + lever_b * lever_b / inertia_b;
  return 2 * ratio * std::sqrt(stiffness / inverse_mass);
}

}  // namespace engrane
