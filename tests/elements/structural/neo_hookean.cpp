// SPDX-License-Identifier: BSD-3-Clause
#include "elements/materials/neo_hookean.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace engrane::elements::materials {
namespace {

constexpr double young = 70, poisson = 0.4;
const NeoHookean rubber = neo_hookean(young, poisson);

Voigt random_strain(std::mt19937& random, Hypothesis hypothesis) {
  std::uniform_real_distribution<double> slope(-0.4, 0.4);
  Mat3 H = Mat3::Zero();
  const Eigen::Index size = hypothesis == Hypothesis::solid ? 3 : 2;
  for (Eigen::Index i = 0; i < size; ++i)
    for (Eigen::Index j = 0; j < size; ++j) H(i, j) = slope(random);
  if (hypothesis == Hypothesis::axisymmetric) H(2, 2) = slope(random);
  const Mat3 E = (H + H.transpose() + H.transpose() * H) / 2;
  return (Voigt() << E.diagonal(), 2 * E(0, 1), 2 * E(1, 2), 2 * E(2, 0)).finished();
}

constexpr double growths[] = {0, 0.15, -0.2};  // free thermal strains

/// Stress is the derivative of the energy, and the moduli that of the stress, whatever the free expansion.
TEST(NeoHookean, DerivativesAreExact) {
  std::mt19937 random(5);
  constexpr double h = 1e-4;
  for (const Hypothesis hypothesis :
       {Hypothesis::plane_stress, Hypothesis::plane_strain, Hypothesis::axisymmetric, Hypothesis::solid})
    for (int sample = 0; sample < 10; ++sample) {
      const Voigt at = random_strain(random, hypothesis);
      const double growth = growths[sample % 3];
      const Response here = respond(rubber, hypothesis, at, growth);
      const auto warmer = [&](double by) { return respond(rubber, hypothesis, at, growth + by).energy; };
      EXPECT_NEAR(here.by_growth, (warmer(-2 * h) - 8 * warmer(-h) + 8 * warmer(h) - warmer(2 * h)) / (12 * h), 1e-9 * young);
      for (Eigen::Index k = 0; k < 6; ++k) {
        if (hypothesis == Hypothesis::plane_stress && (k == 2 || k > 3)) continue;
        const auto shifted = [&](double by) { return respond(rubber, hypothesis, at + by * Voigt::Unit(k), growth); };
        const Response a = shifted(-2 * h), b = shifted(-h), c = shifted(h), d = shifted(2 * h);
        EXPECT_NEAR(here.stress[k], (a.energy - 8 * b.energy + 8 * c.energy - d.energy) / (12 * h), 1e-9 * young);
        const Voigt slope = (a.stress - 8 * b.stress + 8 * c.stress - d.stress) / (12 * h);
        EXPECT_LT((here.moduli.col(k) - slope).norm(), 1e-8 * young);
      }
    }
}

/// At rest it is the linear material, and small strains lose no digits.
TEST(NeoHookean, SmallStrainsAreLinear) {
  for (const Hypothesis hypothesis :
       {Hypothesis::plane_stress, Hypothesis::plane_strain, Hypothesis::axisymmetric, Hypothesis::solid}) {
    const Elasticity law = law_of(hypothesis, isotropic(young, poisson));
    const Moduli off = respond(rubber, hypothesis, Voigt::Zero()).moduli - law.stiffness;
    const double largest = off.topLeftCorner<4, 4>().norm();
    EXPECT_LT(largest, 1e-13 * young);
    Voigt strain;
    strain << 3, -1, hypothesis == Hypothesis::solid ? 2 : 0, 0.7, 0, 0;
    strain *= 1e-11;
    const Response found = respond(rubber, hypothesis, strain);
    const Voigt stress = law.stiffness * strain;
    EXPECT_LT((found.stress - stress).norm(), 1e-9 * stress.norm());
    EXPECT_NEAR(found.transverse, strain[2] + law.transverse.dot(strain), 1e-9 * strain.norm());
    // and so are those of warm bodies: S = D (E − α ΔT)
    const double growth = -1.5e-11;
    Voigt elastic = strain;
    elastic.head<3>().array() -= growth;
    const Response warm = respond(rubber, hypothesis, strain, growth);
    EXPECT_LT((warm.stress - law.stiffness * elastic).norm(), 1e-9 * stress.norm());
    EXPECT_NEAR(warm.transverse, hypothesis == Hypothesis::plane_stress ? law.transverse.dot(elastic) + growth : strain[2],
                1e-9 * strain.norm());
  }
}

/// The stretch 1 + growth in all directions, and any turn, which has no strain, leave it free of stress and energy.
TEST(NeoHookean, FreeExpansionHasNoStress) {
  for (const double growth : {0.15, -0.2, 2.0, 1e-9}) {
    Voigt strain = Voigt::Zero();
    strain.head<3>().setConstant(growth + growth * growth / 2);
    for (const Hypothesis hypothesis : {Hypothesis::plane_stress, Hypothesis::axisymmetric, Hypothesis::solid}) {
      const Response free = respond(rubber, hypothesis, strain, growth);
      EXPECT_LT(free.stress.norm(), 1e-14 * young);
      EXPECT_NEAR(free.energy, 0, 1e-14 * young);
      EXPECT_NEAR(free.transverse, strain[2], 1e-15 * (1 + strain[2]));
    }
  }
  EXPECT_TRUE(std::isnan(respond(rubber, Hypothesis::solid, Voigt::Zero(), -1).energy));
  EXPECT_TRUE(std::isnan(respond(rubber, Hypothesis::solid, Voigt::Zero(), -1.5).stress[0]));
}

/// A warm rod held at its length gets b times as thick: the rod that has grown to 1 + growth is pressed to a = 1/(1 + growth) of
/// its length, and b/(1 + growth) is the stretch across of the rod under tension below.
TEST(NeoHookean, WarmRodHeldAtItsLength) {
  for (const double growth : growths) {
    const double stretch = 1 + growth, a = 1 / stretch;
    double low = 1e-3, high = 10;  // square of the elastic stretch across, by bisection
    for (int i = 0; i < 200; ++i) {
      const double middle = (low + high) / 2;
      (rubber.shear * (middle - 1) + rubber.lambda * std::log(a * middle) > 0 ? high : low) = middle;
    }
    Voigt strain = Voigt::Zero();
    strain.segment<2>(1).setConstant((low * stretch * stretch - 1) / 2);
    const Response held = respond(rubber, Hypothesis::solid, strain, growth);
    EXPECT_NEAR(held.stress[1], 0, 1e-12 * young);
    // force over the first section: that over the grown one, μ (a − b²/a), times the square of the stretch
    EXPECT_NEAR(held.stress[0], rubber.shear * (a - low / a) * stretch * stretch, 1e-12 * young);
    const Response plane = respond(rubber, Hypothesis::plane_stress, strain, growth);
    EXPECT_NEAR(plane.transverse, strain[2], 1e-13);
    EXPECT_NEAR(plane.stress[0], held.stress[0], 1e-12 * young);
    EXPECT_NEAR(plane.energy, held.energy, 1e-13 * young);
  }
}

/// A rod pulled to a times its length gets b times as thick, μ (b² − 1) + λ ln(a b²) = 0, under the force μ (a − b²/a) over its
/// first section: both from the stress across, by hand.
TEST(NeoHookean, RodUnderTension) {
  for (const double a : {0.2, 0.7, 1.0, 1.5, 5.0}) {
    double low = 1e-3, high = 10;  // b², by bisection
    for (int i = 0; i < 200; ++i) {
      const double middle = (low + high) / 2;
      (rubber.shear * (middle - 1) + rubber.lambda * std::log(a * middle) > 0 ? high : low) = middle;
    }
    const double b2 = low;
    Voigt strain = Voigt::Zero();
    strain.head<3>() << (a * a - 1) / 2, (b2 - 1) / 2, (b2 - 1) / 2;
    const Response solid = respond(rubber, Hypothesis::solid, strain);
    EXPECT_NEAR(a * solid.stress[0], rubber.shear * (a - b2 / a), 1e-13 * young);
    EXPECT_NEAR(solid.stress[1], 0, 1e-12 * young / b2);
    strain[2] = 0;
    const Response plane = respond(rubber, Hypothesis::plane_stress, strain);
    EXPECT_NEAR(plane.transverse, (b2 - 1) / 2, 1e-13);
    EXPECT_NEAR(plane.stress[0], solid.stress[0], 1e-12 * young / (a * a));
    EXPECT_NEAR(plane.energy, solid.energy, 1e-13 * young);
    EXPECT_EQ(plane.stress[2], 0);
  }
}

TEST(NeoHookean, NoBodyIsLessThanNothing) {
  Voigt strain = Voigt::Zero();
  strain[0] = -0.6;
  EXPECT_TRUE(std::isnan(respond(rubber, Hypothesis::solid, strain).energy));
  EXPECT_TRUE(std::isnan(respond(rubber, Hypothesis::plane_stress, strain).stress[0]));
}

}  // namespace
}  // namespace engrane::elements::materials
