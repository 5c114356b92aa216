// SPDX-License-Identifier: BSD-3-Clause
// The force components of every kind of pair against the formulas of handbooks (Shigley & Uicker; Shigley & Mischke), and the
// pair's equilibrium.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <random>

#include "elements/gears/gear_pair_cases.hpp"
#include "elements/suite.hpp"
#include "math/rotation.hpp"

namespace engrane::elements::gears {
namespace {

using namespace suite;
using namespace gear_cases;

/// Gives the normal force F between the teeth, and the multipliers of φ₂ and φ₃ that balance ψ.
void balance(const Element& element, StateBuffer& state, double F) {
  const auto rows = [&](const std::array<double, 3>& multipliers) {
    state.multipliers.assign(multipliers.begin(), multipliers.end());
    const auto r = residual_of(element, state);
    return Eigen::Vector2d(r[12], r[13]);
  };
  const Eigen::Vector2d none = rows({F, 0, 0});
  Eigen::Matrix2d K;
  K.col(0) = rows({F, 1, 0}) - none;
  K.col(1) = rows({F, 0, 1}) - none;
  const Eigen::Vector2d balanced = -K.partialPivLu().solve(none);
  state.multipliers = {F, balanced[0], balanced[1]};
}

/// The reference configuration with the normal force F between the teeth, ψ balanced.
StateBuffer loaded(const Element& element, const Case& c, double F) {
  StateBuffer state(element, {{1, c.x_a}, {2, c.x_b}});
  balance(element, state, F);
  return state;
}

struct Components {
  double tangential, radial, axial, torque;
};

struct Loaded {
  Components a, b;
  GearDesign design;
};

Loaded components_of(const Case& c, double F) {
  const auto element = c.build(Mat3::Identity());
  const StateBuffer state = loaded(*element, c, F);
  const auto of = [&](const std::string& wheel) {
    return Components{channel_of(*element, state, "TANGENTIAL_FORCE_" + wheel),
                      channel_of(*element, state, "RADIAL_FORCE_" + wheel), channel_of(*element, state, "AXIAL_FORCE_" + wheel),
                      channel_of(*element, state, "TORQUE_" + wheel)};
  };
  return {of("A"), of("B"), dynamic_cast<const GearPair&>(*element).design()};
}

TEST(GearPairForces, TorqueAndRatio) {
  for (const Case& c : all_cases())
    for (const double F : {7.0, -7.0}) {
      const Loaded l = components_of(c, F);
      const double ca = std::cos(l.design.pressure_angle);
      // F = T/(r cosβ cosα_n); the teeth resist, so their moment is the reverse of what drives
      EXPECT_NEAR(l.a.torque, -F * l.design.lever(0) * ca, 1e-14 * 7) << c.name;
      EXPECT_NEAR(l.b.torque, -F * l.design.lever(1) * ca, 1e-14 * 7) << c.name;
      EXPECT_NEAR(l.b.torque / l.a.torque, static_cast<double>(l.design.teeth[1]) / l.design.teeth[0], 1e-13) << c.name;
      EXPECT_NEAR(l.a.tangential * l.design.radius(0), l.a.torque, 1e-14 * 7) << c.name;
    }
}

/// What one wheel gives the other gets, but for what friction and damping lose and the teeth store: turning wheels of every
/// kind, loaded by their own deflection and its rate.
TEST(GearPairForces, PowerIsLostToFrictionAndDampingAlone) {
  constexpr double k = 30, c = 0.8, x = 0.05;
  for (Case gear : all_cases())
    for (const double extra : {-0.4, 0.0, 0.7}) {  // of B's speed, beyond the ratio: teeth that load and unload
      gear.data.stiffness = k;
      gear.data.damping = c;
      gear.data.friction = {"CONST", {0.1}};
      gear.data.friction_width = 0.05;
      const auto element = gear.build(Mat3::Identity());
      const auto& pair = dynamic_cast<const GearPair&>(*element);
      const GearDesign& d = pair.design();
      const std::array<double, 2> speed{3.0, -3.0 * d.teeth[0] / d.teeth[1] + extra};
      const double rate = d.normal_module / 2 * (d.teeth[0] * speed[0] + d.teeth[1] * speed[1]);  // of phi_1 = 0
      StateBuffer state(*element, {{1, gear.x_a}, {2, gear.x_b}});
      const std::array<Vec3, 2> axle{Vec3(pair.frames().mu.col(0)), Vec3(pair.frames().xi.col(0))};
      for (std::size_t i = 0; i < 2; ++i) {
        state.nodes[i].W = speed[i] * axle[i];
        state.scalar_rates[i] = speed[i];
      }
      state.scalars[2] = x;
      state.scalar_rates[2] = rate;
      const double force = residual_of(*element, state)[14] / std::cos(d.pressure_angle);  // balances u_m
      balance(*element, state, force);
      ASSERT_NEAR(residual_of(*element, state)[14], 0, 1e-12);

      const double taken = channel_of(*element, state, "POWER_A") + channel_of(*element, state, "POWER_B");
      const double lost = element->energies(state.view()).dissipated;
      EXPECT_TRUE(lost > 0 || extra == 0) << gear.name;
      EXPECT_NEAR(taken + lost + k * x * rate, 0, 1e-11 * std::abs(channel_of(*element, state, "POWER_A")))
          << gear.name << ", B faster by " << extra;
    }
}

TEST(GearPairForces, EveryKindByTheSpiralBevelFormulas) {
  // Each member with its own pitch angle γ and spiral ψ: axial, away from the apex,
  // W_t/cosψ (tanφ_n sinγ + s sinψ cosγ); radial, towards the axle, W_t/cosψ (tanφ_n cosγ − s sinψ sinγ). s = +1 on a
  // right-hand member whose tangential force turns it backwards about its outward axle (a driver), −1 when it drives it.
  // With γ = 0 these are the helical formulas, with ψ = 0 those of spur and straight bevel gears.
  for (const Case& c : all_cases())
    for (const double F : {3.0, -3.0}) {
      const Loaded l = components_of(c, F);
      for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) {
        const Components& w = i == 0 ? l.a : l.b;
        const double tan_n = std::tan(l.design.pressure_angle), W_t = std::abs(w.tangential);
        const bool ring = std::cos(l.design.cone[i]) < 0;
        const double outward = l.design.cone[i] < 0 ? -1 : 1;  // the axle's sense away from the apex
        const double gamma = ring ? 0 : std::abs(l.design.cone[i]);
        const double hand = paper_helix(l.design.helix[i], l.design.cone[i]);
        const double s = -(w.tangential > 0 ? 1 : -1) * outward, psi = hand;
        const double axial = W_t / std::cos(psi) * (tan_n * std::sin(gamma) + s * std::sin(psi) * std::cos(gamma));
        const double radial = W_t / std::cos(psi) * (tan_n * std::cos(gamma) - s * std::sin(psi) * std::sin(gamma));
        EXPECT_NEAR(w.axial * outward, axial, 1e-13 * W_t) << c.name << " wheel " << i;
        EXPECT_NEAR(w.radial, ring ? -radial : radial, 1e-13 * W_t) << c.name << " wheel " << i;
      }
    }
}

TEST(GearPairForces, HelicalInTheTransversePlane) {
  const Loaded l = components_of(helical(), 11);
  const double W_t = std::abs(l.a.tangential), tan_t = std::tan(20 * deg) / std::cos(23 * deg);
  EXPECT_NEAR(W_t, 11 * std::cos(20 * deg) * std::cos(23 * deg), 1e-14);
  for (const Components& w : {l.a, l.b}) EXPECT_NEAR(w.radial, W_t * tan_t, 1e-14);
  EXPECT_NEAR(l.a.axial, W_t * std::tan(23 * deg), 1e-14);  // right-hand driver: along the thumb of the turning fingers
  EXPECT_NEAR(l.b.axial, -W_t * std::tan(23 * deg), 1e-14);
}

TEST(GearPairForces, HypoidExample) {
  // z = 11/43, ψ_P = 50°, ψ_G = 31.5°, R_G = 85 mm: R_P = 28.84306742 mm, W_tP/W_tG = 0.75387911, T₂/T₁ = 3.90909091
  GearData data = wheels(11, 43, 2 * 85 * std::cos(31.5 * deg) / 43);
  data.cone = {20, 66};
  data.helix = {-50, 31.5};
  const Loaded l = components_of(placed("hypoid", data, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}), 1000);
  EXPECT_NEAR(l.design.radius(0), 28.84306742, 5e-9);
  EXPECT_NEAR(std::abs(l.a.tangential / l.b.tangential), 0.75387911, 5e-9);
  EXPECT_NEAR(std::abs(l.b.torque / l.a.torque), 43.0 / 11, 1e-13);
}

TEST(GearPairForces, WormExampleWithoutFriction) {
  // 2 threads, 30 teeth, transverse pitch 6 per inch, worm 2 in: lead angle 9.46232221°; W_x = W cosφ_n sinλ on the worm's
  // circumference, W_y = W sinφ_n radially, W_z = W cosφ_n cosλ along its axle
  const double lambda = std::atan(2 * std::numbers::pi / 6 / (2 * std::numbers::pi));
  EXPECT_NEAR(lambda / deg, 9.46232221, 5e-9);
  GearData data = wheels(2, 30, std::cos(lambda) / 6);
  data.pressure_angle = 14.5;
  data.helix = {90 - lambda / deg, lambda / deg};
  const Loaded l = components_of(placed("worm", data, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}), 100);
  const double n = 14.5 * deg;
  EXPECT_NEAR(l.design.radius(0), 1, 1e-14);
  EXPECT_NEAR(l.design.radius(1), 2.5, 1e-14);
  EXPECT_NEAR(std::abs(l.a.tangential), 100 * std::cos(n) * std::sin(lambda), 1e-12);
  EXPECT_NEAR(l.a.radial, 100 * std::sin(n), 1e-12);
  EXPECT_NEAR(std::abs(l.a.axial), 100 * std::cos(n) * std::cos(lambda), 1e-12);
  EXPECT_NEAR(std::abs(l.b.tangential), std::abs(l.a.axial), 1e-12);
  EXPECT_NEAR(std::abs(l.b.axial), std::abs(l.a.tangential), 1e-12);
}

TEST(GearPairForces, PaperBevelWheelOnItsFoundation) {
  // The first example with the bar at 1 rad: force ±1000 (cos1, 0, −sin1) − 363.9702343 (0.1961161 sin1, 0.9805807,
  // 0.1961161 cos1) on the foundation, its moment x_C × force with x_C = 5 (sin1, 0, cos1)
  GearData data = wheels(50, 10, 0.2);
  data.nodes = {1, 2};
  data.axis = {0, 1, 0};
  data.cone = {-std::atan(5) / deg, -std::atan(0.2) / deg};
  const Case c{"paper", data, {0, 0, 0}, {0, 1, 5}};
  const auto element = c.build(Mat3::Identity());
  const double F = 1000 / std::cos(20 * deg), bar = 1;
  StateBuffer state = loaded(*element, c, F);
  const Mat3 C = rotation_exp(bar * Vec3(0, 1, 0));
  state.nodes[1].x = C * c.x_b;
  state.turn(1, C * rotation_exp(5 * bar * Vec3(0, 0, -1)), Vec3::Zero());  // B has turned 5 rad in the bar
  state.scalars = {-bar, 5 * bar};
  std::vector<double> phi(3), rate(3), second(3);
  element->constraint_rates(state.view(), phi, rate, second);
  for (const double p : phi) EXPECT_NEAR(p, 0, 1e-14);
  const auto vector = [&](const std::string& stem) {
    return Vec3(channel_of(*element, state, stem + "X"), channel_of(*element, state, stem + "Y"),
                channel_of(*element, state, stem + "Z"));
  };
  const Vec3 force = vector("FORCE_A"), moment = vector("MOMENT_A"), x_c = 5 * Vec3(std::sin(1), 0, std::cos(1));
  const double side = force.dot(Vec3(std::cos(1), 0, -std::sin(1))) > 0 ? 1 : -1;
  const Vec3 expected = side * 1000 * Vec3(std::cos(1), 0, -std::sin(1)) -
                        363.9702343 * Vec3(0.1961161 * std::sin(1), 0.9805807, 0.1961161 * std::cos(1));
  EXPECT_LT((force - expected).norm(), 1e-4);  // the printed digits
  EXPECT_LT((moment - x_c.cross(force)).norm(), 1e-11);
  EXPECT_LT((vector("CONTACT_") - x_c).norm(), 1e-14);
  EXPECT_NEAR(channel_of(*element, state, "NORMAL_FORCE"), 1064.1777724759, 1e-10);
}

TEST(GearPairForces, RandomCrossedPairsBalance) {
  // cones ±80°, helices ±60°: forces and moments of A and B sum to zero, and the torques are as z_A : z_B
  std::mt19937 random(11);
  std::uniform_real_distribution<double> u(-1, 1);
  double worst_force = 0, worst_moment = 0, worst_ratio = 0, worst_lateral = 0;
  for (int i = 0; i < 500; ++i) {
    GearData data = wheels(5 + static_cast<int>(40 * std::abs(u(random))), 5 + static_cast<int>(40 * std::abs(u(random))), 0.1);
    data.cone = {80 * u(random), 80 * u(random)};
    data.helix = {60 * u(random), 60 * u(random)};
    const Case c = placed("random", data, {u(random), u(random), u(random)}, {u(random), u(random), u(random)},
                          {u(random), u(random), u(random)});
    GearDesign d;
    d.teeth = {data.teeth[0], data.teeth[1]};
    d.normal_module = 0.1;
    for (const std::size_t w : {std::size_t{0}, std::size_t{1}}) {
      d.cone[w] = (*data.cone)[w] * deg;
      d.helix[w] = paper_helix(data.helix[w] * deg, d.cone[w]);
    }
    const Vec3 axle = Vec3(data.axis[0], data.axis[1], data.axis[2]).normalized();
    if (const Closure k = closure(d, c.x_a, c.x_b, axle); k.distance_needed < 0.01 * k.size) continue;
    const auto element = c.build(Mat3::Identity());
    const StateBuffer state = loaded(*element, c, u(random));
    const auto r = residual_of(*element, state);
    const auto at = [&](std::size_t k) { return Vec3(r[k], r[k + 1], r[k + 2]); };
    const double size = at(0).norm();
    worst_force = std::max(worst_force, (at(0) + at(6)).norm() / size);
    const Vec3 sum = cross(c.x_a, at(0)) + at(3) + cross(c.x_b, at(6)) + at(9);
    worst_moment = std::max(worst_moment, sum.norm() / (size * (1 + d.radius(0) + d.radius(1))));
    worst_ratio = std::max(worst_ratio, std::abs(channel_of(*element, state, "TORQUE_B") /
                                                     channel_of(*element, state, "TORQUE_A") * data.teeth[0] / data.teeth[1] -
                                                 1));
    worst_lateral = std::max(worst_lateral, std::abs(state.multipliers[2]) / size);
  }
  EXPECT_LT(worst_force, 1e-15);
  EXPECT_LT(worst_moment, 1e-14);
  EXPECT_LT(worst_ratio, 1e-13);
  EXPECT_LT(worst_lateral, 1e-12);
}

TEST(GearPairForces, SeparationIsTheRadialPart) {
  for (Case c : all_cases()) {
    const Loaded with = components_of(c, 2);
    c.data.separation = {"NO", {}};
    const Loaded without = components_of(c, 2);
    EXPECT_NEAR(with.a.tangential, without.a.tangential, 1e-14);
    EXPECT_NEAR(with.a.torque, without.a.torque, 1e-14);
    const double removed = std::hypot(with.a.radial - without.a.radial, with.a.axial - without.a.axial);
    EXPECT_NEAR(removed, 2 * std::sin(20 * deg), 1e-14) << c.name;
  }
}

}  // namespace
}  // namespace engrane::elements::gears
