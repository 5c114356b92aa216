// SPDX-License-Identifier: BSD-3-Clause
#include "elements/membranes/membrane_law.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "elements/materials/neo_hookean.hpp"

namespace engrane::elements::membranes {

namespace {

using materials::Hypothesis;
using materials::Voigt;

/// Indices of the components 11, 22, 12 in Voigt.
constexpr std::array<Eigen::Index, 3> in_plane = {0, 1, 3};

/// Current over reference area of a skin with the elastic strains of `elastic` and a free strain in all directions.
double area_of(const Plane& elastic, double free) {
  return std::sqrt(std::max((1 + 2 * (elastic[0] + free)) * (1 + 2 * (elastic[1] + free)) - elastic[2] * elastic[2], 0.0));
}

double thinning_of(double transverse, double free) { return std::sqrt(std::max(1 + 2 * (transverse + free), 0.0)); }

/// Response without wrinkling to an elastic strain. The free strain counts only in thinning and area.
SkinResponse taut(const MembraneLaw& law, double tension, const Plane& strain, double free) {
  SkinResponse r;
  double transverse;
  if (law.neo_hookean) {
    Voigt all = Voigt::Zero();
    all(in_plane) = strain;
    const materials::Response found = materials::respond(*law.neo_hookean, Hypothesis::plane_stress, all);
    r.stress = found.stress(in_plane);
    r.moduli = found.moduli(in_plane, in_plane);
    r.energy = found.energy;
    transverse = found.transverse;
  } else {
    const double nu = law.poisson, D = law.young / (1 - nu * nu);
    r.moduli << D, nu * D, 0, nu * D, D, 0, 0, 0, (1 - nu) / 2 * D;
    r.stress << D * (strain[0] + nu * strain[1]), D * (strain[1] + nu * strain[0]), (1 - nu) / 2 * D * strain[2];
    r.energy = r.stress.dot(strain) / 2;
    transverse = -nu / (1 - nu) * (strain[0] + strain[1]);
  }
  r.stress[0] += tension;
  r.stress[1] += tension;
  r.energy += tension * (strain[0] + strain[1]);
  r.by_tension = strain[0] + strain[1];
  r.thinning = thinning_of(transverse, free);
  r.area = area_of(strain, free);
  return r;
}

/// Strip in uniaxial tension: the response of a wrinkled skin along its wrinkles.
struct Strip {
  double stress = 0;   ///< along the strip; if not positive, the strip is slack
  double modulus = 0;  ///< derivative of the stress by the strain along the strip
  double energy = 0;   ///< of a slack strip: that of the stress-free skin
  double by_tension = 0;
  double thinning = 1;
  double area = 1;
};

/// ½ D (E₁² + E₂² + 2ν E₁E₂) + s (E₁ + E₂) equals ½ D (E₂ + ν E₁ + s/D)² + ½ Y (E₁ − E_n)² + W_n, with D = Y/(1 − ν²). The
/// first square vanishes if E₂ is free. The stress-free skin has E₁ = E₂ = E_n = −(1 − ν) s/Y and the energy W_n.
Strip linear_strip(const MembraneLaw& law, double tension, double strain, double free) {
  const double Y = law.young, nu = law.poisson, natural = -(1 - nu) * tension / Y;
  const double along = std::max(strain, natural), across = -nu * along - (1 - nu * nu) * tension / Y;
  const double transverse = -nu / (1 - nu) * (along + across);
  Strip s;
  s.stress = Y * (strain - natural);
  s.modulus = Y;
  s.energy = Y / 2 * (along - natural) * (along - natural) + tension * natural;
  s.by_tension = along + across;
  s.thinning = thinning_of(transverse, free);
  s.area = area_of({along, across, 0}, free);
  return s;
}

/// Root of e^y − μ + a + b y, b ≥ 0. The function is increasing and convex: Newton's iteration converges from any start.
double root(double shear, double a, double b) {
  constexpr int most = 100;
  constexpr double rounding = 1e-15;
  double y = std::log(shear);
  for (int i = 0; i < most; ++i) {
    const double e = std::exp(y), change = -(e - shear + a + b * y) / (e + b);
    y += change;
    if (std::abs(change) <= rounding * std::abs(y)) break;
  }
  return y;
}

/// S_i = μ + s_i − q/C_i with q = μ − λ ln J. The two free directions have C₂ = q/(μ + s) and C₃ = q/μ, which leaves one
/// equation for y = ln q: e^y − μ + λ/2 (ln C₁ + 2y − ln μ(μ + s)) = 0. The stress-free skin also has C₁ = C₂.
Strip neo_hookean_strip(const materials::NeoHookean& m, double tension, double strain) {
  const double mu = m.shear, pulled = mu + tension, logs = std::log(mu) + std::log(pulled), half = m.lambda / 2;
  double C1 = 1 + 2 * strain;
  double q = std::exp(root(mu, half * (std::log(C1) - logs), m.lambda));
  Strip s;
  s.stress = pulled - q / C1;
  if (!(s.stress > 0)) {
    q = std::exp(root(mu, half * (-std::log(pulled) - logs), 3 * half));
    C1 = q / pulled;
  }
  const double C2 = q / pulled, C3 = q / mu, log_J = std::log(C1 * C2 * C3) / 2;
  s.modulus = 2 * q / (C1 * C1) * (1 + half / (q + m.lambda));
  s.energy = mu / 2 * (C1 + C2 + C3 - 3 - 2 * log_J) + half * log_J * log_J + tension / 2 * (C1 + C2 - 2);
  s.by_tension = (C1 + C2 - 2) / 2;
  s.thinning = std::sqrt(C3);
  s.area = std::sqrt(C1 * C2);
  return s;
}

/// Turns the response without wrinkling under a given tension into that with wrinkling. No change if both principal stresses
/// are non-negative.
void relax(const MembraneLaw& law, double tension, const Plane& strain, double free, SkinResponse& r) {
  const double least = (r.stress[0] + r.stress[1]) / 2 - std::hypot((r.stress[0] - r.stress[1]) / 2, r.stress[2]);
  if (!(least < 0)) return;
  const double half = (strain[0] - strain[1]) / 2, shear = strain[2] / 2, radius = std::hypot(half, shear);
  const double largest = (strain[0] + strain[1]) / 2 + radius;
  const Strip strip =
      law.neo_hookean ? neo_hookean_strip(*law.neo_hookean, tension, largest) : linear_strip(law, tension, largest, free);
  const double left = *law.wrinkling, relaxed = 1 - left;
  r.stress *= left;
  r.moduli *= left;
  r.energy = left * r.energy + relaxed * strip.energy;
  r.by_tension = left * r.by_tension + relaxed * strip.by_tension;
  r.thinning = strip.thinning;
  r.area = strip.area;
  r.state = SkinState::slack;
  if (!(strip.stress > 0)) return;
  r.state = SkinState::wrinkled;
  // a is the gradient of E₁ by the strain, b bᵀ/radius its Hessian
  const double c = half / radius, s = shear / radius;
  const Plane a((1 + c) / 2, (1 - c) / 2, s / 2), b(-s / 2, s / 2, c / 2);
  r.stress += relaxed * strip.stress * a;
  r.moduli += relaxed * (strip.modulus * a * a.transpose() + strip.stress / radius * b * b.transpose());
}

/// Response to an elastic strain under a given prestress, wrinkled or not.
///
/// Relaxed energy of Pipkin (1986), IMA J. Appl. Math. 36, 85, and Steigmann (1990), Proc. R. Soc. Lond. A 429, 141: the
/// infimum over arbitrarily fine wrinkles. With E₁ ≥ E₂ it is the unrelaxed energy if both principal stresses are tensile,
/// that of a strip with strain E₁ if the strip is in tension, and otherwise that of the stress-free skin.
///
/// Wrinkling starts at a small compressive stress c: the law is evaluated with tension s + c, and the energy c (E₁ + E₂) is
/// subtracted. A skin without transverse stress, as at free edges, is then taut, and the jump of the moduli is away from the
/// state to which Newton's iteration converges.
SkinResponse respond_elastically(const MembraneLaw& law, double prestress, const Plane& strain, double free) {
  if (!law.wrinkling) return taut(law, prestress, strain, free);
  constexpr double before = 0.1;  // c is the stress of the remaining stiffness ε Y at this strain
  const double pressure = before * *law.wrinkling * law.young, tension = prestress + pressure;
  SkinResponse r = taut(law, tension, strain, free);
  relax(law, tension, strain, free, r);
  r.stress[0] -= pressure;
  r.stress[1] -= pressure;
  r.energy -= pressure * (strain[0] + strain[1]);
  return r;
}

}  // namespace

MembraneLaw membrane_law(const materials::Elasticity& material) {
  const double D = material.stiffness(0, 0), nu = material.stiffness(0, 1) / D;
  return {D * (1 - nu * nu), nu, material.expansion[0], material.neo_hookean, 0, {}};
}

/// With growth, a linear skin has the energy V(E − g 1). A neo-Hookean one has θ³ V(E_e, s/θ) with θ = 1 + g and
/// E_e = (E − g (2 + g)/2 1)/θ²: its material stands in an expanded reference configuration, whose prestress is s too.
SkinResponse respond(const MembraneLaw& law, const Plane& strain, double growth) {
  const Plane in_surface(1, 1, 0);
  if (!law.neo_hookean) {
    SkinResponse r = respond_elastically(law, law.tension, strain - growth * in_surface, growth);
    r.by_growth = -r.stress.dot(in_surface);
    return r;
  }
  const double stretch = 1 + growth, square = stretch * stretch, prestress = law.tension / stretch;
  const Plane elastic = (strain - growth * (2 + growth) / 2 * in_surface) / square;
  SkinResponse r = respond_elastically(law, prestress, elastic, 0);
  r.by_growth = square * (3 * r.energy - r.stress.dot(2 * elastic + in_surface)) - law.tension * stretch * r.by_tension;
  r.by_tension *= square;
  r.energy *= stretch * square;
  r.stress *= stretch;
  r.moduli /= stretch;
  r.thinning *= stretch;
  r.area *= square;
  return r;
}

}  // namespace engrane::elements::membranes
