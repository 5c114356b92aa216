// SPDX-License-Identifier: BSD-3-Clause
// The laws behind the teeth one by one: course of the stiffness, ISO 6336-1, power law, opening flanks, friction.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "elements/common/friction_law.hpp"
#include "elements/gears/gear_pair.hpp"
#include "elements/gears/mesh_stiffness.hpp"
#include "elements/jets.hpp"
#include "elements/suite.hpp"
#include "math/angle.hpp"

namespace engrane::elements::gears {
namespace {

using test::expect_jet, test::slope;

using std::numbers::pi;

MeshStiffness square(double contact_ratio, double edge) {
  MeshStiffness course;
  course.kind = MeshStiffness::Kind::square;
  course.contact_ratio = contact_ratio;
  course.edge = edge;
  return course;
}

TEST(MeshStiffness, SquareWaveCountsPairs) {
  const MeshStiffness course = square(1.6, 0.1);
  // two pairs for 0.6 of a pitch around τ/2π = 1/4, one for the rest; k_m is the mean
  EXPECT_NEAR(course.at(0.25 * 2 * pi).f, 2 / 1.6, 1e-15);
  EXPECT_NEAR(course.at(0.75 * 2 * pi).f, 1 / 1.6, 1e-15);
  EXPECT_NEAR(course.at((0.25 + 0.29 - 0.05) * 2 * pi).f, 2 / 1.6, 1e-15);
  EXPECT_NEAR(course.at((0.25 + 0.31 + 0.05) * 2 * pi).f, 1 / 1.6, 1e-15);
  EXPECT_NEAR(course.at((0.25 + 0.30) * 2 * pi).f, 1.5 / 1.6, 1e-15);
  for (const double ratio : {1.6, 2.3, 1.05}) {
    double mean = 0;
    const int n = 4000;
    for (int i = 0; i < n; ++i) mean += square(ratio, 0.04).at((i + 0.5) / n * 2 * pi).f / n;
    EXPECT_NEAR(mean, 1, 1e-6) << ratio;
  }
  for (const double cycle : {-0.95, -0.45, 0.1, 0.52, 0.57, 0.97, 7.93})  // on plateaus and both edges
    expect_jet([&](double t) { return course.at(t); }, cycle * 2 * pi, 1e-4, 2e-6);
}

TEST(MeshStiffness, FourierAndTable) {
  MeshStiffness course;
  course.kind = MeshStiffness::Kind::fourier;
  course.coefficients = {0.2, -0.1, 0, 0.05};
  const suite::Wave wave(1, 0.3, 2 * pi, 0.2);
  MeshStiffness table;
  table.kind = MeshStiffness::Kind::table;
  table.function = &wave;
  for (const double tau : {-3.0, 0.0, 0.4, 9.1}) {
    EXPECT_NEAR(course.at(tau).f, 1 + 0.2 * std::cos(tau) - 0.1 * std::sin(tau) + 0.05 * std::sin(2 * tau), 1e-15);
    EXPECT_NEAR(table.at(tau).f, 1 + 0.3 * std::sin(tau + 0.2), 1e-14);
    expect_jet([&](double t) { return course.at(t); }, tau, 1e-3, 1e-9);
  }
}

TEST(MeshStiffness, Iso6336) {
  IsoMesh mesh;
  mesh.teeth = {40, 20};  // the pinion may be either wheel
  mesh.pressure_angle = 20 * degree;
  mesh.contact_ratio = 1.6353;
  mesh.width = 0.02;
  mesh.E = {206e9, 206e9};
  // by hand: q' = 0.04723 + 0.15551/20 + 0.25791/40 = 0.06145325 mm µm/N, c' = 0.8·0.975/q' = 12.6926 N/(mm µm), within a
  // tenth of the 14 that the norm gives for a first estimate; c_γ = c' (0.75·1.6353 + 0.25) = 18.7402
  EXPECT_NEAR(iso_mesh_stiffness(mesh), 18.7402e9 * 0.02 * std::pow(std::cos(20 * degree), 2), 1e-5 * 18.7e9 * 0.02);
  const double steel = iso_mesh_stiffness(mesh);
  mesh.E[1] = 206e9 / 3;  // 2 E₁E₂/(E₁ + E₂) = E/2
  EXPECT_NEAR(iso_mesh_stiffness(mesh), steel / 2, 1e-9 * steel);
  mesh.E = {206000, 206000};  // N and mm
  mesh.width = 20;
  EXPECT_NEAR(iso_mesh_stiffness(mesh), steel / 1000, 1e-12 * steel);
  mesh.ring = {true, false};  // a ring counts as a rack
  EXPECT_GT(iso_mesh_stiffness(mesh), steel / 1000);
  // helical: cosβ/q′(z_n) along the line of action, (cosα_t/cosβ)² along the circumference
  mesh.ring = {false, false};
  mesh.helix = 30 * degree;
  const double c = std::cos(30 * degree), q = 0.04723 + 0.15551 * c * c * c / 20 + 0.25791 * c * c * c / 40;
  const double alpha_t = std::atan(std::tan(20 * degree) / c);
  const double expected = 0.78 * c / q * (0.75 * 1.6353 + 0.25) * 1e3 * 20 * std::pow(std::cos(alpha_t) / c, 2);
  EXPECT_NEAR(iso_mesh_stiffness(mesh), expected, 1e-9 * expected);
}

TEST(ToothLaws, PowerOfTheLoad) {
  ToothLaw law;
  law.stiffness = 7;
  law.exponent = 10.0 / 9;
  law.reference = 0.01;
  law.backlash = 0.1;
  EXPECT_NEAR(law.deflection(0.01).f, 0.01, 1e-17) << "k_m is the secant at the reference";
  EXPECT_NEAR(law.deflection(0.02).f, 0.01 * std::pow(2, 10.0 / 9), 1e-16);
  EXPECT_NEAR(law.deflection(-0.12).f, -0.01 * std::pow(2, 10.0 / 9), 1e-16);
  EXPECT_EQ(law.deflection(-0.05).f, 0);
  for (const double x : {0.003, 0.05, -0.13}) {
    expect_jet([&](double t) { return law.deflection(t); }, x, 1e-5, 1e-6);
    EXPECT_NEAR(slope([&](double t) { return law.potential(t); }, x, 1e-5), 7 * law.deflection(x).f, 1e-9);
  }
}

TEST(ToothLaws, FlanksOpenByTheInvolute) {
  GearDesign design;
  design.teeth = {20, 40};
  design.normal_module = 2;
  design.pressure_angle = 20 * degree;
  for (const bool internal : {false, true})
    for (const double helix : {0.0, 18 * degree}) {
      design.cone = {0, internal ? pi : 0};
      design.helix = {helix, -helix};
      const ContactGeometry g = contact_geometry(design, 20);
      const double a0 = (internal ? 20 : 60) / std::cos(helix), alpha = design.transverse_pressure_angle(0);
      EXPECT_NEAR(g.center_distance, a0, 1e-12);
      const double opening = 0.1, a = a0 + (internal ? -1 : 1) * opening;  // of an internal pair: centres approach
      const double running = std::acos(a0 / a * std::cos(alpha));
      EXPECT_NEAR(g.working_pressure_angle(opening), running, 1e-14);
      const auto involute = [](double t) { return std::tan(t) - t; };
      const double sum = (internal ? -1 : 1) * a0 * std::cos(alpha);  // r_bA ± r_bB
      EXPECT_NEAR(g.flank_opening(opening).f, std::cos(helix) / std::cos(alpha) * sum * (involute(running) - involute(alpha)),
                  1e-12);
      EXPECT_GT(g.flank_opening(opening).f, 0);
      EXPECT_NEAR(g.flank_opening(0).d1, std::cos(helix) * std::tan(alpha), 1e-14);
      expect_jet([&](double t) { return g.flank_opening(t); }, opening, 1e-3, 1e-8);
    }
}

TEST(Friction, CoulombBeyondTheWidth) {
  FrictionLaw law;
  law.mu = 0.3;
  law.width = 0.01;
  for (const double v : {0.01, 0.5, 20.0}) EXPECT_NEAR(law.over_speed(v * v, 1.0) * v, 0.3, 1e-13);
  EXPECT_NEAR(law.over_speed(0.0, 1.0), 0.3 * 15 / 8 / 0.01, 1e-9);
  double last = 0;
  for (double v = 0; v < 0.011; v += 1e-4) {  // grows up to μ and never beyond
    const double force = law.over_speed(v * v, 1.0) * v;
    EXPECT_GE(force, last - 1e-12);
    EXPECT_LE(force, 0.3 + 1e-12);
    last = force;
  }
  // value, slope and curvature join at the width
  const auto force = [&](double v) { return law.over_speed(v * v, 1.0) * v; };
  EXPECT_NEAR((force(0.01) - force(0.01 - 1e-6)) / 1e-6, 0, 1e-4);
}

TEST(Friction, StribeckFallsAndGrows) {
  FrictionLaw law;
  law.kind = FrictionLaw::Kind::stribeck;
  law.mu = 0.3;
  law.kinetic = 0.1;
  law.stribeck_speed = 0.5;
  law.viscous = 0.02;
  law.width = 1e-3;
  for (const double v : {0.01, 0.4, 3.0}) {
    EXPECT_NEAR(law.coefficient(v).f, 0.1 + 0.2 * std::exp(-v * v / 0.25) + 0.02 * v, 1e-15);
    EXPECT_NEAR(law.coefficient(v).d1, slope([&](double s) { return law.coefficient(s).f; }, v, 1e-3), 1e-9);
    EXPECT_NEAR(law.coefficient(v).d2, slope([&](double s) { return law.coefficient(s).d1; }, v, 1e-3), 1e-8);
    EXPECT_NEAR(law.over_speed(v * v, 1.0) * v, law.coefficient(v).f, 1e-12);
  }
}

/// A pair of 1.4 on the path with three reliefs.
ToothLaw relieved() {
  ToothLaw law;
  law.stiffness = 1;
  law.relief.approach = 0.8;
  law.relief.recess = 0.6;
  law.relief.base_pitch = 1;
  law.relief.flank = 0.21;
  law.relief.edge = 0.05;
  law.relief.ramps = {{true, 0.3, 0.25, 2}, {false, 0.2, 0.35, 1.5}, {false, 0.1, 0.2, 3}};
  return law;
}

// The force of the pairs by their definition, in a loop of its own; energies and derivatives by differences.
TEST(ToothRelief, SumOfPairs) {
  for (const double crown : {0.0, 0.4}) {
    ToothLaw law = relieved();
    law.crown = crown;
    const auto energy = [&](double tau, double x, bool back) { return law.pressed(tau, x, back).energy; };
    for (const double tau : {0.1, 0.7, 1.9, 3.3, 4.4, 5.9})
      for (const double x : {0.05, 0.17, 0.6})
        for (const bool back : {false, true}) {
          const ToothLaw::Pressed p = law.pressed(tau, x, back);
          double force = 0;
          for (int j = -9; j < 9; ++j) {
            const double place = (back ? -1 : 1) * tau / (2 * std::numbers::pi) + 0.21 + j;
            double lack = 0;
            if (place > 0.35) lack += 0.3 * std::pow((place - 0.35) / 0.25, 2);
            if (place < -0.45) lack += 0.2 * std::pow((-0.45 - place) / 0.35, 1.5);
            if (place < -0.6) lack += 0.1 * std::pow((-0.6 - place) / 0.2, 3);
            const double there = smooth_step(place + 0.8, 0.05).f * smooth_step(0.6 - place, 0.05).f;
            const double d = x - lack;
            double one = std::max(d, 0.0);
            if (crown > 0 && d > 0) one = d < crown ? 2.0 / 3.0 * d * std::sqrt(d / crown) : d - crown / 3;
            force += there * one / 1.4;
          }
          EXPECT_NEAR(p.force, force, 1e-14) << tau << " " << x;
          constexpr double h = 1e-5;
          const auto by_x = [&](auto f) { return (f(tau, x + h) - f(tau, x - h)) / (2 * h); };
          const auto by_tau = [&](auto f) { return (f(tau + h, x) - f(tau - h, x)) / (2 * h); };
          const auto V = [&](double t, double d) { return energy(t, d, back); };
          const auto F = [&](double t, double d) { return law.pressed(t, d, back).force; };
          const auto W = [&](double t, double d) { return law.pressed(t, d, back).energy_by_phase; };
          EXPECT_NEAR(by_x(V), p.force, 1e-8);
          EXPECT_NEAR(by_tau(V), p.energy_by_phase, 1e-8);
          EXPECT_NEAR(by_x(F), p.by_depth, 1e-6);
          EXPECT_NEAR(by_tau(F), p.by_phase, 1e-6);
          EXPECT_NEAR(by_x(W), p.by_phase, 1e-6);
          EXPECT_NEAR(by_tau(W), p.energy_by_phase_twice, 1e-5);
        }
  }
}

// Without anything taken off, the pairs are as stiff in the mean as the mesh.
TEST(ToothRelief, MeanStiffnessIsThatOfTheMesh) {
  ToothLaw law = relieved();
  for (auto& ramp : law.relief.ramps) ramp.amount = 0;
  double mean = 0;
  constexpr int n = 4000;
  for (int i = 0; i < n; ++i) mean += law.pressed(2 * std::numbers::pi * i / n, 0.5).by_depth / n;
  EXPECT_NEAR(mean, 1, 1e-6);
}

}  // namespace
}  // namespace engrane::elements::gears
