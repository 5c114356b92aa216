// SPDX-License-Identifier: BSD-3-Clause
// Radau IIA against its own theory: coefficients, order in positions, velocities, accelerations and multipliers, damping.
#include <fmt/format.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "known_motions.hpp"
#include "run_deck.hpp"
#include "solve/schemes/collocation.hpp"

namespace engrane::test {
namespace {

/// What decks have after `.SAM TYPE DYNAMIC`.
constexpr const char* radau = "SCHEME RADAU PREC 1e-13";

TEST(Radau, HasTheCoefficientsOfTheLiterature) {
  // Hairer and Wanner (1996), table IV.5.6
  const double r6 = std::sqrt(6.0);
  const Collocation three = Collocation::radau();
  EXPECT_NEAR(three.a(0, 0), (88 - 7 * r6) / 360, 1e-15);
  EXPECT_NEAR(three.a(0, 1), (296 - 169 * r6) / 1800, 1e-15);
  EXPECT_NEAR(three.a(1, 2), (-2 - 3 * r6) / 225, 1e-15);
  EXPECT_NEAR(three.a(2, 0), (16 - r6) / 36, 1e-15);
  EXPECT_NEAR(three.a(2, 2), 1.0 / 9, 1e-15);
  // the same, IV.8: eigenvalues of the inverse
  const double root = std::cbrt(81.0) - std::cbrt(9.0);
  Eigen::Matrix3d blocks = Eigen::Matrix3d::Zero();
  for (const auto& b : three.blocks) {
    blocks(b.first, b.first) = b.alpha;
    if (!b.complex()) {
      EXPECT_NEAR(b.alpha, 30 / (6 + root), 1e-13);
      continue;
    }
    blocks(b.first + 1, b.first + 1) = b.alpha;
    blocks(b.first, b.first + 1) = -b.beta;
    blocks(b.first + 1, b.first) = b.beta;
  }
  EXPECT_LT((three.transform * blocks * three.untransform - three.inverse).norm(), 1e-13);
}

TEST(Radau, EstimatesItsErrorWithTheFormulaOfTheLiterature) {
  // Hairer and Wanner (1996), IV.8.20: γ₀/3 (−13 − 7√6, −13 + 7√6, −1)
  const Collocation c = Collocation::radau();
  const double r6 = std::sqrt(6.0), gamma = (6 + std::cbrt(81.0) - std::cbrt(9.0)) / 30;
  EXPECT_NEAR(c.embedded_first, gamma, 1e-14);
  EXPECT_NEAR(c.embedded[0], gamma / 3 * (-13 - 7 * r6), 1e-13);
  EXPECT_NEAR(c.embedded[1], gamma / 3 * (-13 + 7 * r6), 1e-13);
  EXPECT_NEAR(c.embedded[2], -gamma / 3, 1e-13);
}

TEST(Radau, AmplifiesByItsPadeApproximant) {
  // R(z), the (2, 3) approximant of exp(z): x after one step from (1, 0) is Re R(iωh)
  for (const double h : {0.1, 0.7, 5.0}) {
    const std::complex<double> z(0, 2 * std::numbers::pi * h);
    const std::complex<double> fifth =
        (1.0 + 2.0 * z / 5.0 + z * z / 20.0) / (1.0 - 3.0 * z / 5.0 + 3.0 * z * z / 20.0 - z * z * z / 60.0);
    DeckRun deck(oscillator(h, h, radau));
    const double x = deck.node(deck.run(), 1).x[0];
    EXPECT_NEAR(x, fifth.real(), 1e-11);
  }
}

TEST(Radau, IsOfOrderFiveInPositionVelocityAccelerationAndMultiplier) {
  // IFToMM benchmark A01 at t = 1; the speed from the energy, acceleration and reaction from both
  const double x1 = 0.98629175113188, y1 = -0.16501085312554;
  const double speed = std::sqrt(2 * 9.81 * -y1);
  double error[3][4];
  for (int level = 0; level < 3; ++level) {
    DeckRun deck(pendulum(0.125 / (1 << level), radau));
    const Configuration end = deck.run();
    const NodeState& node = deck.node(end, 1);
    error[level][0] = std::hypot(node.x[0] - x1, node.x[1] - y1);
    error[level][1] = std::abs(node.v.norm() - speed);
    const Vec3 reaction(deck.channel(end, 1, "FORCE_X"), deck.channel(end, 1, "FORCE_Y"), 0);
    error[level][3] = std::abs(reaction.norm() - std::abs(speed * speed + 9.81 * -y1));
    // a = T r/L + g, with T the pull towards the pivot
    const double pull = speed * speed + 9.81 * -y1;
    error[level][2] = (node.a - Vec3(-pull * x1, -pull * y1 - 9.81, 0)).norm();
  }
  for (int what = 0; what < 4; ++what) {
    const double slope = std::log2(error[1][what] / error[2][what]);
    EXPECT_NEAR(slope, 5, 0.35) << "what " << what << ", errors " << error[0][what] << " " << error[1][what] << " "
                                << error[2][what];
  }
}

/// Heavy top on a fixed point, as in decks/elements/bodies/rigid_body_top.dat.
std::string top(double h) {
  return fmt::format(R"(
.NOE
 I 1 X 0 0 0
 I 2 X 0 1 0
.MCE
 I 1 RIGID N 1 2 M 15 J 0.234375 0.46875 0.234375 CG 0 1 0
 I 2 SPHERICAL N 0 1 AT 0 0 0
.CLM
 STRU ACC VAL 0 0 -9.81
.INI
 VIT NOEUD 1 C 4 5 6 V 0 150 -4.61538
.SAM TYPE DYNAMIC SCHEME RADAU PREC 1e-12
.SUB TF 0.032 H {}
)",
                     h);
}

/// A bevel wheel that an arm on a spring carries round one that is held, under its weight; teeth are rigid.
std::string bevel(double h) {
  return fmt::format(R"(
.NOE
 I 1 X 0 0 0
 I 2 X 0 1 5
 I 4 X 0 1 0
.MCE
 I 1 GEAR N 1 2 AXIS 0 1 0 Z 50 10 MN 0.2 ALPHA 20 R 5 1 $
     CONE (-atan(5)*180/PI) (-atan(0.2)*180/PI) HELIX 0 0
 I 3 HINGE N 4 2 AXIS 0 0 -1 AT 0 1 5
 I 4 HINGE N 0 4 AXIS 0 1 0
 I 5 INERTIA N 2 M 2 J 0.6 0.6 1
 I 6 INERTIA N 4 M 1 J 3 2 1
 I 7 TSPRING N 0 4 AXIS 0 1 0 K 900
.CLM
 FIX NOEUD 1 C 1 2 3 4 5 6
 STRU ACC VAL 0 0 -9.81
.INI
 VIT NOEUD 4 C 5 V 2
.SAM TYPE DYNAMIC SCHEME RADAU PREC 1e-12
.SUB TF 1.6 H {}
)",
                     h);
}

struct Seen {
  Vec3 x, v, f;
};

/// The order that three runs with halved steps tell.
void expect_order_five(const Seen (&runs)[3], const char* model) {
  const auto slope = [&](const Vec3 Seen::*what) {
    return std::log2((runs[0].*what - runs[1].*what).norm() / (runs[1].*what - runs[2].*what).norm());
  };
  EXPECT_NEAR(slope(&Seen::x), 5, 0.4) << model << ": positions";
  EXPECT_NEAR(slope(&Seen::v), 5, 0.4) << model << ": velocities";
  EXPECT_NEAR(slope(&Seen::f), 5, 0.4) << model << ": multipliers";
}

TEST(Radau, IsOfOrderFiveOnTheHeavyTop) {
  Seen runs[3];
  for (int level = 0; level < 3; ++level) {
    DeckRun deck(top(2e-3 / (1 << level)));
    const Configuration end = deck.run();
    const NodeState& node = deck.node(end, 2);
    runs[level] = {node.x, node.v,
                   Vec3(deck.channel(end, 2, "FORCE_X"), deck.channel(end, 2, "FORCE_Y"), deck.channel(end, 2, "FORCE_Z"))};
  }
  expect_order_five(runs, "heavy top");
}

TEST(Radau, IsOfOrderFiveOnAPairOfGears) {
  Seen runs[3];
  for (int level = 0; level < 3; ++level) {
    DeckRun deck(bevel(0.08 / (1 << level)));
    const Configuration end = deck.run();
    const NodeState& node = deck.node(end, 2);
    runs[level] = {node.x, node.v, Vec3(deck.channel(end, 1, "NORMAL_FORCE"), 0, 0)};
  }
  expect_order_five(runs, "bevel pair");
}

TEST(Radau, KeepsItsOrderWhenTheStepChanges) {
  const double x1 = 0.98629175113188;
  double error[2];
  for (int level = 0; level < 2; ++level) {
    const double h = 0.125 / (1 << level);
    DeckRun deck(pendulum(h, radau));
    const auto scheme = make_scheme(deck.context());
    Configuration now = deck.context().numbering.reference_configuration(0), next;
    scheme->start(now);
    for (int i = 0; now.time < 1 - 1e-12; ++i) {
      ASSERT_TRUE(scheme->attempt(now, std::min(i % 3 == 0 ? 0.5 * h : h, 1 - now.time), next).converged());
      scheme->accept();
      std::swap(now, next);
    }
    error[level] = std::abs(deck.node(now, 1).x[0] - x1);
  }
  EXPECT_GT(std::log2(error[0] / error[1]), 4.5) << error[0] << " " << error[1];
}

}  // namespace
}  // namespace engrane::test
