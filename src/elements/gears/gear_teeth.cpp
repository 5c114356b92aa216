// SPDX-License-Identifier: BSD-3-Clause
#include "elements/gears/gear_teeth.hpp"

#include <algorithm>
#include <cmath>

#include "math/angle.hpp"

namespace engrane::elements::gears {

namespace {

void add(Function::Jet& sum, const Function::Jet& term) {
  sum.f += term.f;
  sum.d1 += term.d1;
  sum.d2 += term.d2;
  sum.d3 += term.d3;
}

/// A function of an angle in degrees, with derivatives with respect to radians.
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

Function::Jet ToothLaw::ramp(double x) const {
  if (onset == 0 && std::abs(x) < blur) return {0.5 * (x + blur), 0.5, 0, 0};
  return rounded_ramp(x, onset);
}

Function::Jet ToothLaw::flank(double x) const {
  if (crown > 0) {
    if (x <= 0) return {};
    if (x >= crown) return {x - crown / 3, 1, 0, 0};
    const double root = std::sqrt(x / crown);
    return {2.0 / 3.0 * x * root, root, 0.5 * root / x, -0.25 * root / (x * x)};
  }
  if (exponent == 1) return ramp(x);
  if (x <= 0) return {};
  const double p = exponent, y = x / reference, power = std::pow(y, p - 2);
  return {reference * power * y * y, p * power * y, p * (p - 1) * power / reference,
          p * (p - 1) * (p - 2) * power / (y * reference * reference)};
}

double ToothLaw::flank_integral(double x) const {
  if (crown > 0) {
    if (x <= 0) return 0;
    return x < crown ? 4.0 / 15.0 * x * x * std::sqrt(x / crown) : 0.5 * x * x - crown * x / 3 + 0.1 * crown * crown;
  }
  if (exponent == 1 && onset == 0) {
    if (std::abs(x) < blur) return 0.25 * (x + blur) * (x + blur);
    return x < 0 ? 0 : 0.5 * (x * x + blur * blur);
  }
  if (exponent == 1) return rounded_ramp_integral(x, onset);
  return x <= 0 ? 0 : reference * reference / (exponent + 1) * std::pow(x / reference, exponent + 1);
}

ToothLaw::Pressed ToothLaw::pressed_pairs(double phase, double depth) const {
  const double along = relief.base_pitch / whole_turn, share = 1 / relief.contact_ratio();
  Pressed p;
  for_each_pair(phase, [&](const Function::Jet& w, const Function::Jet& lack) {
    const double x = depth - lack.f, G = flank_integral(x);
    const Function::Jet F = flank(x);
    p.force += share * w.f * F.f;
    p.by_depth += share * w.f * F.d1;
    p.by_phase += share * along * (w.d1 * F.f - w.f * F.d1 * lack.d1);
    p.energy += share * w.f * G;
    p.energy_by_phase += share * along * (w.d1 * G - w.f * F.f * lack.d1);
    p.energy_by_phase_twice +=
        share * along * along * (w.d2 * G - 2 * w.d1 * F.f * lack.d1 + w.f * F.d1 * lack.d1 * lack.d1 - w.f * F.f * lack.d2);
  });
  // factor of the force over that without relief; it limits the damping of a flank in contact
  const Function::Jet plain = flank(depth);
  p.factor = {1, 0, 0, 0};
  if (plain.f > 0 && plain.d1 > 0)
    p.factor = {p.force / plain.f, p.by_phase / plain.f, 0, (p.by_depth / plain.d1 - p.force / plain.f) / plain.f};
  return p;
}

std::vector<ToothLaw::PairDepth> ToothLaw::pair_depths(double phase, double depth, bool back) const {
  const double along = (back ? -1 : 1) * relief.base_pitch / whole_turn;
  std::vector<PairDepth> pairs;
  for_each_pair(back ? -phase : phase, [&](const Function::Jet& w, const Function::Jet& lack) {
    const double x = depth - lack.f;
    pairs.push_back({w.f * x, w.f, along * (w.d1 * x - w.f * lack.d1)});
  });
  std::sort(pairs.begin(), pairs.end(), [](const PairDepth& a, const PairDepth& b) { return a.weighted > b.weighted; });
  return pairs;
}

ToothLaw::Pressed ToothLaw::pressed(double phase, double depth, bool back) const {
  if (relief.active()) {
    Pressed p = pressed_pairs(back ? -phase : phase, depth);
    if (back) {
      p.by_phase = -p.by_phase;
      p.energy_by_phase = -p.energy_by_phase;
      p.factor[1] = -p.factor[1];
    }
    return p;
  }
  Pressed p;
  const Function::Jet d = flank(depth);
  const user::Results f = course.at(phase, d.f);
  p.factor = f;
  p.force = f[0] * d.f;
  p.by_depth = (f[3] * d.f + f[0]) * d.d1;
  p.by_phase = f[1] * d.f;
  // 8-point Gauss rule, exact for factors up to degree 14 in the deflection; the rounded onset is integrated separately
  constexpr std::array<double, 4> place{0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975362};
  constexpr std::array<double, 4> weight{0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};
  const auto integrate = [&](double from, double to) {
    const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
    for (std::size_t i = 0; i < place.size(); ++i)
      for (const double side : {-1.0, 1.0}) {
        const double D = flank(middle + side * half * place[i]).f;
        const user::Results y = course.at(phase, D);
        p.energy += half * weight[i] * y[0] * D;
        p.energy_by_phase += half * weight[i] * y[1] * D;
        p.energy_by_phase_twice += half * weight[i] * y[2] * D;
      }
  };
  const double edge = 0.5 * onset;
  if (edge > 0 && depth > -edge) integrate(-edge, std::min(depth, edge));
  if (depth > edge) integrate(edge, depth);
  return p;
}

Function::Jet ToothLaw::deflection(double x) const {
  if (backlash == 0 && exponent == 1 && crown == 0) return {x, 1, 0, 0};
  const Function::Jet front = flank(x), back = flank(-backlash - x);
  return {front.f - back.f, front.d1 + back.d1, front.d2 - back.d2, front.d3 + back.d3};
}

double ToothLaw::deflection_integral(double x) const {
  if (backlash == 0 && exponent == 1 && crown == 0) return 0.5 * x * x;
  return flank_integral(x) + flank_integral(-backlash - x);
}

double tooth_damping(double ratio, double stiffness, double inertia_a, double inertia_b, double lever_a, double lever_b) {
  const double inverse_mass = lever_a * lever_a / inertia_a + lever_b * lever_b / inertia_b;
  return 2 * ratio * std::sqrt(stiffness / inverse_mass);
}

}  // namespace engrane::elements::gears
