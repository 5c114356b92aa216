// SPDX-License-Identifier: BSD-3-Clause
// The generalised-α integrator against its own theory: spectral radius, period error, and second order in positions,
// velocities and multipliers.
#include <cmath>
#include <complex>
#include <numbers>

#include "known_motions.hpp"
#include "run_deck.hpp"

namespace engrane::test {
namespace {

constexpr double pi = std::numbers::pi;

struct Root {
  double radius, period_error;
};

/// Principal root of the amplification matrix, from the recurrence x₊ = 2ρcosθ x − ρ² x₋ once the third root has died.
Root principal_root(double h, const std::string& scheme) {
  DeckRun deck(oscillator(h, 200 * h, scheme));
  std::vector<double> x;
  deck.run([&](const Configuration& c, const StepReport&) { x.push_back(deck.node(c, 1).x[0]); });
  const std::size_t n = 150;
  // least squares over some periods would only hide a fault: two equations, two unknowns
  const double det = x[n] * -x[n - 10] + x[n - 9] * x[n - 1];
  const double a = (x[n + 1] * -x[n - 10] + x[n - 8] * x[n - 1]) / det;
  const double b = (x[n] * x[n - 8] - x[n - 9] * x[n + 1]) / det;
  const double radius = std::sqrt(b), theta = std::acos(a / (2 * radius));
  return {radius, 2 * pi * h / theta - 1};
}

TEST(GeneralizedAlpha, HasItsTheoreticalDampingAndPeriod) {
  struct Case {
    const char* scheme;
    double radius, period_error;
  };
  // closed form of the amplification matrix at h/T = 0.05
  for (const Case& c : {Case{"RHO 0.8", 0.9999935094, 8.62328252e-3}, Case{"RHO 0.5", 0.9998308496, 1.21566439e-2},
                        Case{"RHO 0", 0.9964910914, 3.90844098e-2}}) {
    const Root root = principal_root(0.05, c.scheme);
    EXPECT_NEAR(root.radius, c.radius, 2e-9) << c.scheme;
    EXPECT_NEAR(root.period_error, c.period_error, 2e-9) << c.scheme;
  }
}

TEST(GeneralizedAlpha, NewmarkLosesNothing) { EXPECT_NEAR(principal_root(0.05, "SCHEME NEWMARK").radius, 1.0, 1e-10); }

TEST(GeneralizedAlpha, RadiusTendsToRhoAtInfinity) {
  // three equal roots −ρ at infinite frequency: x grows as n² ρⁿ at most, so a ratio far out tends to ρ from above
  DeckRun deck(oscillator(1e6, 400e6, "RHO 0.8 PREC 1e-15"));
  std::vector<double> x;
  deck.run([&](const Configuration& c, const StepReport&) { x.push_back(std::abs(deck.node(c, 1).x[0])); });
  EXPECT_NEAR(std::pow(x[120] / x[60], 1.0 / 60), 0.8, 0.025);
}

TEST(GeneralizedAlpha, IsOfSecondOrderInPositionVelocityAndMultiplier) {
  // IFToMM benchmark A01 at t = 1; the speed from the energy, the reaction from both
  const double x1 = 0.98629175113188, y1 = -0.16501085312554;
  const double speed = std::sqrt(2 * 9.81 * -y1);
  for (const char* scheme : {"RHO 0.8", "RHO 0.5", "SCHEME NEWMARK", "SCHEME HHT ALPHA 0.1", "SCHEME BOSSAK ALPHA 0.1"}) {
    double error[3][3];
    for (int level = 0; level < 3; ++level) {
      DeckRun deck(pendulum(0.01 / (1 << level), scheme + std::string(" PREC 1e-12")));
      const Configuration end = deck.run();
      const NodeState& node = deck.node(end, 1);
      error[level][0] = std::hypot(node.x[0] - x1, node.x[1] - y1);
      error[level][1] = std::abs(node.v.norm() - speed);
      const Vec3 reaction(deck.channel(end, 1, "FORCE_X"), deck.channel(end, 1, "FORCE_Y"), 0);
      // towards the pivot: m v²/L and the component of the weight
      error[level][2] = std::abs(reaction.norm() - std::abs(speed * speed + 9.81 * -y1));
    }
    for (int what = 0; what < 3; ++what)
      for (int level = 1; level < 3; ++level) {
        const double slope = std::log2(error[level - 1][what] / error[level][what]);
        EXPECT_NEAR(slope, 2.0, 0.15) << scheme << ": "
                                      << (what == 0   ? "position"
                                          : what == 1 ? "velocity"
                                                      : "multiplier")
                                      << ", error " << error[level][what];
      }
  }
}

TEST(GeneralizedAlpha, KeepsItsOrderWhenTheStepChanges) {
  // the same end reached with a step that was not the one the accelerations were started for
  const double x1 = 0.98629175113188;
  double error[2];
  for (int level = 0; level < 2; ++level) {
    DeckRun deck(pendulum(0.01 / (1 << level), "RHO 0.8 PREC 1e-12"));
    const auto scheme = make_scheme(deck.context());
    Configuration now = deck.context().numbering.reference_configuration(0), next;
    scheme->start(now);
    const double h = 0.01 / (1 << level);
    for (int i = 0; now.time < 1 - 1e-12; ++i) {
      const double step = std::min(i % 3 == 0 ? 0.5 * h : h, 1 - now.time);
      ASSERT_TRUE(scheme->attempt(now, step, next).converged());
      scheme->accept();
      std::swap(now, next);
    }
    error[level] = std::abs(deck.node(now, 1).x[0] - x1);
  }
  EXPECT_NEAR(std::log2(error[0] / error[1]), 2.0, 0.25) << error[0] << " " << error[1];
}

}  // namespace
}  // namespace engrane::test
