// SPDX-License-Identifier: BSD-3-Clause
// The suite on gear pairs of every kind. Forces against handbook formulas: gear_pair_forces.cpp; teeth: gear_pair_teeth.cpp.
#include "elements/gears/gear_pair.hpp"

#include <gtest/gtest.h>

#include "elements/gears/gear_pair_cases.hpp"
#include "elements/suite.hpp"
#include "math/rotation.hpp"

namespace engrane::elements::gears {
namespace {

using namespace suite;
using namespace gear_cases;

TEST(GearPair, SuiteOfEveryKind) {
  for (const Case& c : all_cases()) run_suite(subject(c));
}

TEST(GearPair, SuiteWithoutSeparation) {
  for (Case c : all_cases()) {
    c.data.separation = {"NO", {}};
    Subject s = subject(c);
    s.skip.clear();
    run_suite(s);
  }
}

TEST(GearPair, SuiteOfElasticTeeth) {
  // in front, in the gap, behind, and within either onset of contact
  for (const double x : {0.3, -0.25, -0.9, 0.02, -0.03, -0.52, -0.47}) {
    for (const char* damping : {"", "ALWAYS", "CONTACT"}) {
      Case c = helical();
      c.name += " x " + std::to_string(x) + " damping " + damping;
      c.data.stiffness = 30;
      c.data.backlash = 0.5;
      c.data.onset = 0.2;
      c.data.error = {"FOURIER", {0.01, 0.02, 0, -0.005}};
      if (*damping) {
        c.data.damping = 2;
        c.data.damping_mode = {damping, {}};
      }
      Subject s = subject(c);
      s.build_swapped = {};  // the error belongs to wheel A
      s.step = 2e-4;
      s.tolerance = 1e-7;
      s.adjust = [x, c](StateBuffer& state, Random&) {
        const auto element = c.build(Mat3::Identity());
        approach(dynamic_cast<const GearPair&>(*element), state, x);
      };
      s.skip[Check::zero] = "the error is not zero at rest";
      s.skip[Check::rigid] = "the error is not zero at rest";
      if (*damping) s.skip[Check::lagrange] = "a damper has no potential";
      run_suite(s);
    }
  }
}

TEST(GearPair, SuiteOnTheGround) {
  Case c = spur();
  c.data.nodes = {0, 2};
  Subject s = subject(c);
  s.nodes[0] = Vec3::Zero();
  run_suite(s);
}

TEST(GearPair, Extremes) {
  for (const double length : {1e-9, 1.0, 1e6})
    for (const double stiffness : {1e-6, 1e15})
      for (Case c : all_cases()) {
        c = c.scaled(length);
        c.data.stiffness = stiffness;
        c.data.damping = stiffness;
        c.data.backlash = 1e-3 * length;
        c.data.error = {"COS", {1e-3 * length}};
        Subject s = subject(c);
        s.length = s.velocity = length;
        run_extreme(s);
      }
}

TEST(GearPair, WholeTurnsMakeNoDifference) {
  // 10⁶ and 10⁹ turns of A: the frame, the tooth phase and so every force are those of the first turn, to the last bit
  for (const Case& c : all_cases()) {
    const auto element = c.build(Mat3::Identity());
    Random random(5);
    Subject s = subject(c);
    const StateBuffer state = random_state(s, *element, random);
    const auto r = residual_of(*element, state);
    for (const double turns : {1e6, 1e9}) {
      StateBuffer turned = state;
      turned.history[0] += turns * c.data.teeth[1];
      turned.history[1] -= turns * c.data.teeth[0];
      EXPECT_EQ(residual_of(*element, turned), r);
    }
    StateBuffer tooth = state;  // one tooth too far on B is a tooth pitch of φ₁
    tooth.history = {1e9 * c.data.teeth[1], -1e9 * c.data.teeth[0] + 1};
    const auto& d = dynamic_cast<const GearPair&>(*element).design();
    const std::size_t phi_1 = 12 + state.scalars.size();
    EXPECT_NEAR(residual_of(*element, tooth)[phi_1] - r[phi_1], 2 * std::numbers::pi * d.lever(1) * std::cos(d.pressure_angle),
                1e-12 * d.lever(1));
  }
}

TEST(GearPair, CommitCountsTurns) {
  // 2·10⁵ steps of about a third of a turn; B follows. Afterwards φ₁ is what it was, and PSI_A the sum of the steps.
  Case c = spur();
  const auto element = c.build(Mat3::Identity());
  StateBuffer state(*element, {{1, c.x_a}, {2, c.x_b}});
  const double ratio = static_cast<double>(c.data.teeth[0]) / c.data.teeth[1], step = 2 * std::numbers::pi * 0.3;
  for (int i = 0; i < 200000; ++i) {
    state.scalars[0] += step;
    state.scalars[1] -= ratio * step;
    state.commit(*element);
    ASSERT_LE(std::abs(state.scalars[0]), std::numbers::pi * (1 + 1e-12));
  }
  EXPECT_EQ(state.history[0], 60000);
  EXPECT_NEAR(channel_of(*element, state, "PSI_A"), 2 * std::numbers::pi * 60000, 1e-5);
  std::vector<double> phi(3), rate(3), second(3);
  element->constraint_rates(state.view(), phi, rate, second);
  EXPECT_NEAR(phi[0], 0, 1e-9);  // the steps' own rounding, 2·10⁵ times
}

TEST(GearPair, GradientsOfThePrint) {
  // In an aligned state B kλ is (25) and (26) as printed.
  for (const Case& c : all_cases()) {
    Case without = c;
    without.data.separation = {"NO", {}};
    const auto element = without.build(Mat3::Identity());
    const auto& pair = dynamic_cast<const GearPair&>(*element);
    const GearDesign& d = pair.design();
    const Mat3 mu = pair.frames().mu, xi = pair.frames().xi;
    const Mat3 Y_a = tooth_axes(d.cone[0], d.helix[0]), Y_b = mating_tooth_axes(d.cone[1], d.helix[1]);
    const Mat3 eta_a = mu * Y_a, eta_b = xi * Y_b;
    const Vec3 x_c = c.x_b + d.radius(1) * xi.col(1), r_b = d.radius(1) * xi.col(1);
    const Vec3 eta_3 = eta_a.col(2), eta_2 = eta_a.col(1);
    StateBuffer state(*element, {{1, c.x_a}, {2, c.x_b}});
    state.multipliers = {0, 1, 0};
    auto r = residual_of(*element, state);
    std::vector<double> printed;
    const auto put = [&](const Vec3& v) { printed.insert(printed.end(), {v[0], v[1], v[2]}); };
    put(eta_3);
    put(cross(eta_3, Vec3(c.x_a - x_c)));
    put(-eta_3);
    put(cross(eta_3, r_b));
    printed.push_back((Y_a(2, 2) * mu.col(1) - Y_a(1, 2) * mu.col(2)).dot(c.x_a - x_c));
    printed.push_back(d.radius(1) * xi.col(2).dot(eta_3));
    for (std::size_t i = 0; i < printed.size(); ++i) EXPECT_NEAR(-r[i], printed[i], 1e-13 * d.radius(0)) << c.name << " φ2 " << i;
    state.multipliers = {0, 0, 1};
    r = residual_of(*element, state);
    printed.clear();
    const Vec3 couple = cross(eta_2, Vec3(eta_b.col(2)));
    put(Vec3::Zero());
    put(couple);
    put(Vec3::Zero());
    put(-couple);
    printed.push_back(-Y_a(1, 1) * mu.col(2).dot(eta_b.col(2)));
    printed.push_back((Y_b(2, 2) * xi.col(1) - Y_b(1, 2) * xi.col(2)).dot(eta_2));
    for (std::size_t i = 0; i < printed.size(); ++i) EXPECT_NEAR(-r[i], printed[i], 1e-13) << c.name << " φ3 " << i;
  }
}

TEST(GearPair, StaysMeshedWhenTurned) {
  // B carried round A, planetary fashion, with both wheels rolling: the constraints hold at every angle and speed
  for (const Case& c : all_cases()) {
    const auto element = c.build(Mat3::Identity());
    const auto& pair = dynamic_cast<const GearPair&>(*element);
    const Vec3 mu_1 = pair.frames().mu.col(0), xi_1 = pair.frames().xi.col(0);
    for (const double carrier : {0.0, 0.7, 2.9, -40.0}) {
      const double psi_a = 1.3 - carrier, psi_b = -psi_a * c.data.teeth[0] / c.data.teeth[1];
      const Mat3 C = rotation_exp(carrier * mu_1);  // turns the frame about the axle of A
      StateBuffer state(*element, {{1, c.x_a}, {2, c.x_b}});
      state.nodes[1].x = c.x_a + C * (c.x_b - c.x_a);
      state.turn(0, C * rotation_exp(psi_a * mu_1), Vec3::Zero());
      state.turn(1, C * rotation_exp(psi_b * xi_1), Vec3::Zero());
      state.scalars[0] = psi_a;
      state.scalars[1] = psi_b;
      std::vector<double> phi(3), rate(3), second(3);
      element->constraint_rates(state.view(), phi, rate, second);
      const double size = pair.design().radius(0);
      for (const double p : phi) EXPECT_NEAR(p, 0, 1e-14 * size * (1 + std::abs(carrier))) << c.name << " at " << carrier;
    }
  }
}

}  // namespace
}  // namespace engrane::elements::gears
