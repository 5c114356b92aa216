// SPDX-License-Identifier: BSD-3-Clause
#include "elements/gears/hypoid_cones.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

#include "elements/gears/gear_geometry.hpp"
#include "math/dual.hpp"

namespace engrane::elements::gears {

namespace {

using D = Dual<3>;
using Unknowns = Eigen::Vector3d;  // γ_P, γ_G, ε = ψ_P − ψ_G

struct Radii {
  D pinion, ring;
};

Radii radii(const HypoidDesign& h, const D& spiral_difference) {
  const D ring_cosine = cos(D(h.pinion_spiral) - spiral_difference);
  const D module = h.normal_module ? D(*h.normal_module) : 2 * *h.ring_radius * ring_cosine / h.ring_teeth;
  return {h.pinion_teeth * module / (2 * std::cos(h.pinion_spiral)), h.ring_teeth * module / (2 * ring_cosine)};
}

/// The three conditions, relative to the ring's radius. They lead from the bevel pair (`part` 0, with the cone angles `bevel`)
/// to the hypoid pair `h` (`part` 1).
std::array<D, 3> conditions(const HypoidDesign& h, const std::array<double, 2>& bevel, double part, const Unknowns& u) {
  std::array<D, 3> x{D(u[0]), D(u[1]), D(u[2])};
  for (std::size_t i = 0; i < 3; ++i) x[i].d[i] = 1;
  const D &cone_p = x[0], &cone_g = x[1], &epsilon = x[2];
  const Radii r = radii(h, epsilon);
  const double shaft_sine = std::sin(h.shaft_angle), shaft_cosine = std::cos(h.shaft_angle);
  const D sp = sin(cone_p), cp = cos(cone_p), sg = sin(cone_g), cg = cos(cone_g), se = sin(epsilon), ce = cos(epsilon);

  std::array<D, 3> f;
  std::size_t next = 0;
  f[next++] = cp * cg * ce - sp * sg - shaft_cosine;
  if (h.offset && h.ring_spiral) {
    // both are given: divided by sinε, so that the condition remains regular as both tend to zero
    f[next++] = (r.pinion * cg + r.ring * cp - *h.offset * shaft_sine / std::sin(h.pinion_spiral - *h.ring_spiral)) / r.ring;
  } else if (h.offset) {
    f[next++] = ((r.pinion * cg + r.ring * cp) * se - part * *h.offset * shaft_sine) / r.ring;
  }
  if (h.ring_spiral) f[next++] = epsilon - part * (h.pinion_spiral - *h.ring_spiral);
  if (h.ring_cone) f[next++] = cone_g - (bevel[1] + part * (*h.ring_cone - bevel[1]));
  if (next < 3) {
    const D Z_12 = cg * sp * ce + sg * cp, Z_21 = sg * cp * ce + cg * sp;
    f[next++] = cg * (shaft_sine * shaft_sine) - sg * (r.pinion / r.ring * Z_12 + shaft_cosine * Z_21);
  }
  assert(next == 3);
  return f;
}

double size(const std::array<D, 3>& f) { return std::max({std::abs(f[0].value), std::abs(f[1].value), std::abs(f[2].value)}); }

/// Newton's method with the step halved until the residual decreases.
bool solve(const HypoidDesign& h, const std::array<double, 2>& bevel, double part, Unknowns& u) {
  constexpr double accuracy = 1e-14;
  auto f = conditions(h, bevel, part, u);
  for (int iteration = 0; iteration < 50; ++iteration) {
    const double before = size(f);
    if (before < accuracy) return true;
    Eigen::Matrix3d J;
    Eigen::Vector3d b;
    for (int i = 0; i < 3; ++i) {
      const D& row = f[static_cast<std::size_t>(i)];
      b[i] = row.value;
      for (int j = 0; j < 3; ++j) J(i, j) = row.d[static_cast<std::size_t>(j)];
    }
    const Unknowns step = J.partialPivLu().solve(b);
    if (!step.allFinite()) return false;
    double fraction = 1;
    Unknowns next = u - step;
    auto g = conditions(h, bevel, part, next);
    while (!(size(g) < before) && fraction > 1e-4) {
      fraction /= 2;
      next = u - fraction * step;
      g = conditions(h, bevel, part, next);
    }
    if (!(size(g) < before)) return before < 100 * accuracy;  // converged to rounding error, or failed
    u = next;
    f = g;
  }
  return size(f) < 100 * accuracy;
}

}  // namespace

std::optional<HypoidCones> hypoid_cones(const HypoidDesign& h) {
  assert(h.ring_radius.has_value() != h.normal_module.has_value());
  const auto bevel = cones_of_shaft_angle(h.shaft_angle, {h.pinion_teeth, h.ring_teeth});
  Unknowns u(bevel[0], bevel[1], 0);
  if (h.offset && h.ring_spiral) u[2] = h.pinion_spiral - *h.ring_spiral;
  constexpr int stages = 16;
  for (int stage = 1; stage <= stages; ++stage)
    if (!solve(h, bevel, h.offset && h.ring_spiral ? 1.0 : static_cast<double>(stage) / stages, u)) return {};
  HypoidCones cones;
  cones.pinion_cone = u[0];
  cones.ring_cone = u[1];
  cones.ring_spiral = h.pinion_spiral - u[2];
  constexpr double right = std::numbers::pi / 2;
  if (std::abs(u[0]) >= right || std::abs(u[1]) >= right || std::abs(cones.ring_spiral) >= right) return {};
  const Radii r = radii(h, D(u[2]));
  cones.normal_module = 2 * r.ring.value * std::cos(cones.ring_spiral) / h.ring_teeth;
  cones.offset = (r.pinion.value * std::cos(u[1]) + r.ring.value * std::cos(u[0])) * std::sin(u[2]) / std::sin(h.shaft_angle);
  return cones;
}

}  // namespace engrane::elements::gears
