// SPDX-License-Identifier: BSD-3-Clause
#include "elements/membranes/membrane_law.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace engrane::elements::membranes {
namespace {

constexpr double young = 50, poisson = 0.3;

MembraneLaw law(bool rubber, double tension, double slack) {
  materials::Elastic material = materials::isotropic(young, poisson);
  if (rubber) material.neo_hookean = materials::neo_hookean(young, poisson);
  MembraneLaw skin = membrane_law(materials::law_of(materials::Hypothesis::plane_stress, material));
  skin.tension = tension;
  skin.wrinkling = slack;
  return skin;
}

/// Principal strains, the larger one turned from the first axis by an angle.
Plane strain(double larger, double smaller, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {larger * c * c + smaller * s * s, larger * s * s + smaller * c * c, 2 * (larger - smaller) * s * c};
}

struct Case {
  SkinState state;
  double larger, smaller;
};
constexpr Case cases[] = {{SkinState::taut, 0.4, 0.1},        {SkinState::taut, 0.2, 0.19},   {SkinState::wrinkled, 0.3, -0.2},
                          {SkinState::wrinkled, 1.3, -0.485}, {SkinState::slack, -0.1, -0.2}, {SkinState::slack, -0.2, -0.45}};

/// Stress is the derivative of the energy, moduli those of the stress, whatever the state.
TEST(MembraneLaw, DerivesFromItsEnergy) {
  for (const bool rubber : {false, true})
    for (const double tension : {0.0, 4.0})
      for (const Case& c : cases) {
        const MembraneLaw skin = law(rubber, tension, 0.01);
        const Plane e = strain(c.larger, c.smaller, 0.7);
        const SkinResponse r = respond(skin, e);
        EXPECT_EQ(r.state, c.state) << rubber << tension << c.larger;
        const double step = 4e-4;
        for (Eigen::Index i = 0; i < 3; ++i) {
          const auto at = [&](double steps) { return respond(skin, Plane(e + steps * step * Plane::Unit(i))); };
          const auto slope = [&](const auto& value) {  // of order 6
            return (45 * (value(at(1)) - value(at(-1))) - 9 * (value(at(2)) - value(at(-2))) + (value(at(3)) - value(at(-3)))) /
                   (60 * step);
          };
          EXPECT_NEAR(slope([](const SkinResponse& s) { return s.energy; }), r.stress[i], 1e-7 * young);
          for (Eigen::Index j = 0; j < 3; ++j)
            EXPECT_NEAR(slope([j](const SkinResponse& s) { return s.stress[j]; }), r.moduli(j, i), 1e-6 * young);
        }
      }
}

/// The energy of a warm skin gives its stress, moduli and the power of heating; a skin that is as much larger has the stress of
/// a cold one.
TEST(MembraneLaw, GrowsWithTemperature) {
  for (const bool rubber : {false, true})
    for (const double tension : {0.0, 4.0})
      for (const double growth : {-0.2, 0.1, 0.5})
        for (const Case& c : cases) {
          const MembraneLaw skin = law(rubber, tension, 0.01);
          const double stretch = 1 + growth, free = rubber ? growth * (2 + growth) / 2 : growth;
          const Plane elastic = strain(c.larger, c.smaller, 0.7);
          const Plane e = (rubber ? stretch * stretch : 1) * elastic + free * Plane(1, 1, 0);
          const SkinResponse r = respond(skin, e, growth);
          EXPECT_EQ(r.state, c.state) << rubber << tension << c.larger;
          const double step = 2e-4;
          const auto slope = [step](const auto& at) {  // of order 6
            return (45 * (at(step) - at(-step)) - 9 * (at(2 * step) - at(-2 * step)) + (at(3 * step) - at(-3 * step))) /
                   (60 * step);
          };
          EXPECT_NEAR(slope([&](double by) { return respond(skin, e, growth + by).energy; }), r.by_growth, 1e-7 * young);
          const auto tauter = [&](double by) { return respond(law(rubber, tension + by, 0.01), e, growth).energy; };
          EXPECT_NEAR(slope(tauter), r.by_tension, 1e-8);
          for (Eigen::Index i = 0; i < 3; ++i) {
            const auto at = [&](double by) { return respond(skin, Plane(e + by * Plane::Unit(i)), growth); };
            EXPECT_NEAR(slope([&](double by) { return at(by).energy; }), r.stress[i], 1e-7 * young);
            for (Eigen::Index j = 0; j < 3; ++j)
              EXPECT_NEAR(slope([&](double by) { return at(by).stress[j]; }), r.moduli(j, i), 2e-6 * young);
          }
          const SkinResponse cold = respond(law(rubber, rubber ? tension / stretch : tension, 0.01), elastic);
          EXPECT_LT((r.stress - (rubber ? stretch : 1) * cold.stress).norm(), 1e-13 * young);
          if (!rubber) continue;
          EXPECT_NEAR(r.thinning * r.area, cold.thinning * cold.area * stretch * stretch * stretch, 1e-13);
        }
}

/// A free skin grows by α ΔT in all directions without stress; one that cannot has E α ΔT/(1 − ν).
TEST(MembraneLaw, FreeAndHeld) {
  const double growth = 0.02;
  MembraneLaw skin;
  for (const bool rubber : {true, false}) {
    skin = law(rubber, 0, 0);
    skin.wrinkling.reset();
    const double free = rubber ? growth * (2 + growth) / 2 : growth;
    const SkinResponse grown = respond(skin, free * Plane(1, 1, 0), growth);
    EXPECT_LT(grown.stress.norm(), 1e-15 * young);
    EXPECT_NEAR(grown.thinning, std::sqrt(1 + 2 * free), 1e-15);
    EXPECT_NEAR(grown.area, 1 + 2 * free, 1e-15);
  }
  const SkinResponse held = respond(skin, Plane::Zero(), growth);
  EXPECT_LT((held.stress + young * growth / (1 - poisson) * Plane(1, 1, 0)).norm(), 1e-15 * young);
}

/// Energy, stress, thickness and area go over from state to state without a jump.
TEST(MembraneLaw, StatesMeet) {
  for (const bool rubber : {false, true})
    for (const double tension : {0.0, 4.0}) {
      const MembraneLaw skin = law(rubber, tension, 1e-4);
      for (const double angle : {0.3, 1.2}) {
        SkinResponse last = respond(skin, strain(0.3, 0.25, angle));
        int changes = 0;
        const double steps = 20000;
        for (double i = 1; i <= steps; ++i) {  // from taut through wrinkled to slack
          const double t = i / steps;
          const SkinResponse now = respond(skin, strain(0.3 - 0.5 * t, 0.25 - 0.65 * t, angle));
          changes += now.state != last.state;
          EXPECT_LT((now.stress - last.stress).norm(), 200 * young / steps);
          EXPECT_LT(std::abs(now.energy - last.energy), 10 * young / steps);
          EXPECT_LT(std::abs(now.thinning - last.thinning), 2 / steps);
          EXPECT_LT(std::abs(now.area - last.area), 4 / steps);
          last = now;
        }
        EXPECT_EQ(changes, 2);
        EXPECT_EQ(last.state, SkinState::slack);
      }
    }
}

/// Where it wrinkles the stress is along the wrinkles alone, and that of a strip: Young's modulus times the strain.
TEST(MembraneLaw, WrinkledIsAStrip) {
  const SkinResponse r = respond(law(false, 0, 0), strain(0.2, -0.3, std::numbers::pi / 6));
  const Plane along(0.75, 0.25, std::sqrt(3.0) / 4);
  EXPECT_LT((r.stress - young * 0.2 * along).norm(), 1e-13);
  // a neo-Hookean strip, whose two free stretches are one: its own equation, solved by halving
  const materials::NeoHookean m = materials::neo_hookean(young, poisson);
  const double C = 1.4;
  double low = 0.1, high = 2;
  for (int i = 0; i < 80; ++i) {
    const double b = (low + high) / 2, free = m.shear * (b - 1) + m.lambda / 2 * std::log(C * b * b);
    (free > 0 ? high : low) = b;
  }
  const double stress = m.shear * (1 - 1 / C) + m.lambda / 2 * std::log(C * low * low) / C;
  EXPECT_LT((respond(law(true, 0, 0), strain(0.2, -0.3, std::numbers::pi / 6)).stress - stress * along).norm(), 1e-12);
}

/// No wrinkle makes the energy larger, and none more than the least over all widths.
TEST(MembraneLaw, RelaxedEnergyIsTheLeast) {
  for (const bool rubber : {false, true})
    for (const double tension : {0.0, 4.0}) {
      const double relaxed = respond(law(rubber, tension, 0), strain(0.2, -0.3, 0.4)).energy;
      MembraneLaw stiff = law(rubber, tension, 0);
      stiff.wrinkling.reset();
      double least = 1e9;
      for (double across = -0.3; across < 0.2; across += 1e-5)
        least = std::min(least, respond(stiff, strain(0.2, across, 0.4)).energy);
      EXPECT_NEAR(relaxed, least, 1e-9 * young);
    }
}

}  // namespace
}  // namespace engrane::elements::membranes
