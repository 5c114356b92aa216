// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "elements/gears/gear_pair_cases.hpp"
#include "elements/gears/gear_teeth.hpp"
#include "elements/jets.hpp"
#include "elements/suite.hpp"

namespace engrane::elements::gears {
namespace {

using namespace suite;
using namespace gear_cases;
using test::expect_jet, test::slope;

/// A table that repeats with the tooth: 0.001 (1 − cos(25 ψ)), ψ in degrees.
class ToothWave : public Function {
 public:
  explicit ToothWave(double period) : rate_(2 * std::numbers::pi / period) {}
  Jet at(double x) const override {
    const double c = std::cos(rate_ * x), s = std::sin(rate_ * x), a = 0.001;
    return {a * (1 - c), a * rate_ * s, a * rate_ * rate_ * c, -a * rate_ * rate_ * rate_ * s};
  }
  double integral(double) const override { return 0; }

 private:
  double rate_;
};

TEST(GearTeeth, RoundedRamp) {
  for (const double x : {-0.6, -0.2, 0.0, 0.1, 0.31, 0.7}) {
    expect_jet([](double t) { return rounded_ramp(t, 1); }, x, 1e-3, 1e-10);
    EXPECT_NEAR(slope([](double t) { return rounded_ramp_integral(t, 1); }, x, 1e-3), rounded_ramp(x, 1).f, 1e-12);
  }
  EXPECT_EQ(rounded_ramp(0.5, 1).f, 0.5);  // exact from the end of the rounding on
  EXPECT_EQ(rounded_ramp(-0.5, 1).f, 0);
  for (const double end : {-0.5, 0.5})  // value, slope and curvature join
    for (const auto member : {&Function::Jet::f, &Function::Jet::d1, &Function::Jet::d2})
      EXPECT_NEAR(rounded_ramp(end - 1e-13, 1).*member, rounded_ramp(end + 1e-13, 1).*member, 1e-11);
  EXPECT_EQ(rounded_ramp(1e-3, 0).f, 1e-3);  // width 0 is the corner
  EXPECT_EQ(rounded_ramp(-1e-3, 0).f, 0);
}

TEST(GearTeeth, DeflectionIsThePapersOutsideTheOnset) {
  ToothLaw law;
  law.stiffness = 5;
  law.backlash = 0.2;
  law.onset = 2e-4;
  for (const double x : {0.3, 0.001, 1e-4}) {
    EXPECT_EQ(law.deflection(x).f, x);
    EXPECT_EQ(law.contact(x), 1);
  }
  for (const double x : {-0.0001, -0.1, -0.1999}) {
    EXPECT_EQ(law.deflection(x).f, 0);
    EXPECT_EQ(law.contact(x), 0);
    EXPECT_EQ(law.potential(x), 0);
  }
  for (const double x : {-0.2001, -0.5}) {
    EXPECT_NEAR(law.deflection(x).f, x + 0.2, 1e-16);
    EXPECT_EQ(law.contact(x), -1);
  }
  EXPECT_NEAR(law.potential(0.3), 2.5 * 0.09, 1e-8);  // ½ k x², but for the rounding's 0.025 w²
  law.backlash = 0;
  for (const double x : {0.3, -0.3}) EXPECT_EQ(law.deflection(x).f, x);
}

TEST(GearTeeth, AnExactCornerIsStraightWithinRounding) {
  ToothLaw law;
  law.stiffness = 1;
  law.backlash = 1;
  law.blur = 0.01;
  for (const double x : {0.01, 0.3}) EXPECT_EQ(law.flank(x).f, x);
  for (const double x : {-0.01, -0.3}) EXPECT_EQ(law.flank(x).f, 0);
  for (const double x : {-0.007, 0.0, 0.004}) EXPECT_EQ(law.flank(x).d1, 0.5);
  for (const double x : {-0.02, -0.004, 0.006, 0.2})
    EXPECT_NEAR((law.flank_integral(x + 1e-4) - law.flank_integral(x - 1e-4)) / 2e-4, law.flank(x).f, 1e-12);
  for (const double end : {-0.01, 0.01}) {  // no jump of the force, nor of what it stores
    EXPECT_NEAR(law.flank(end - 1e-13).f, law.flank(end + 1e-13).f, 1e-12);
    EXPECT_NEAR(law.flank_integral(end - 1e-13), law.flank_integral(end + 1e-13), 1e-14);
  }
}

TEST(GearTeeth, ErrorsAndTheirDerivatives) {
  const ToothWave wave(360.0 / 25);
  TransmissionError cosine, fourier, table;
  cosine.kind = TransmissionError::Kind::cosine;
  fourier.kind = TransmissionError::Kind::fourier;
  table.kind = TransmissionError::Kind::table;
  cosine.teeth = fourier.teeth = table.teeth = 25;
  cosine.amplitude = 0.001;
  fourier.coefficients = {-0.001, 0, 0, 0, 0.0002, -0.0003};
  table.function = &wave;
  for (const double psi : {-2.0, 0.013, 1.1}) {
    for (const auto* error : {&cosine, &fourier, &table})
      expect_jet([&](double t) { return error->of_a(t, {}); }, psi, 1e-4, 1e-8);
    EXPECT_NEAR(cosine.of_a(psi, {}).f, 0.001 * (1 - std::cos(25 * psi)), 1e-18);
    EXPECT_NEAR(table.of_a(psi, {}).f, cosine.of_a(psi, {}).f, 1e-15);
    EXPECT_NEAR(fourier.of_a(psi, {}).f, -0.001 * std::cos(25 * psi) + 0.0002 * std::cos(75 * psi) - 0.0003 * std::sin(75 * psi),
                1e-17);
  }
}

template <class T>
T damping(const ToothLaw& law, const T& x, const T& rate) {
  const T front = x, back = -law.backlash - x;
  const auto elastic = [&](const T& depth) {
    const Function::Jet f = law.flank(value_of(depth));
    return T(law.stiffness * compose(depth, f.f, f.d1, f.d2));
  };
  return law.damping_force(front, back, elastic(front), elastic(back), rate);
}

TEST(GearTeeth, TouchingTeethNeverPull) {
  ToothLaw law;
  law.stiffness = 1e7;
  law.damping = 3e3;
  law.backlash = 2e-3;
  law.onset = 2e-6;
  law.mode = ToothLaw::Damping::contact;
  for (double x = -4e-3; x <= 2e-3; x += 3.7e-7)
    for (const double rate : {-50.0, -1.0, -1e-2, 0.0, 1e-2, 1.0, 50.0}) {
      const double force = law.stiffness * law.elastic_deflection(x) + damping(law, x, rate);
      if (x > 1e-6) {
        ASSERT_GE(force, 0) << x << " " << rate;
      } else if (x < -1e-6 && x > -2e-3 + 1e-6) {
        ASSERT_EQ(force, 0) << x << " " << rate;  // apart
      } else if (x < -2e-3 - 1e-6) {
        ASSERT_LE(force, 0) << x << " " << rate;
      }
      ASSERT_GE(damping(law, x, rate) * rate, 0) << "damping makes energy at " << x << " " << rate;
    }
  // where the flank is pressed well enough it is the paper's c_m du/dt
  EXPECT_EQ(damping(law, 1e-4, 0.3), 3e3 * 0.3);
  EXPECT_NEAR(damping(law, 1e-4, -0.29), -3e3 * 0.29, 1e-12);
  law.mode = ToothLaw::Damping::always;
  EXPECT_EQ(damping(law, -1e-3, -0.3), -3e3 * 0.3);
}

TEST(GearTeeth, DampingHasASlopeEverywhere) {
  ToothLaw law;
  law.stiffness = 2;
  law.damping = 0.7;
  law.backlash = 1;
  law.onset = 0.3;
  law.mode = ToothLaw::Damping::contact;
  for (double x = -1.5; x < 0.6; x += 0.0137)
    for (double rate = -3; rate < 3; rate += 0.0913) {
      Dual<2> dx(x), dr(rate);
      dx.d[0] = dr.d[1] = 1;
      const Dual<2> f = damping(law, dx, dr);
      const double h = 1e-7;  // first order: steps over the joints of the law must not show
      EXPECT_NEAR(f.d[0], (damping(law, x + h, rate) - damping(law, x - h, rate)) / (2 * h), 2e-5) << x << " " << rate;
      EXPECT_NEAR(f.d[1], (damping(law, x, rate + h) - damping(law, x, rate - h)) / (2 * h), 2e-5) << x << " " << rate;
    }
}

TEST(GearTeeth, DampingCoefficient) {
  // Özgüven's pair: m_e = I_A I_B/(I_A r_B² + I_B r_A²) = 0.0102/(2·1.9685²)
  const double r = 3.937 / 2, m_e = 0.0102 * 0.0102 / (0.0102 * r * r + 0.0102 * r * r);
  EXPECT_NEAR(tooth_damping(0.1, 1.477e7, 0.0102, 0.0102, r, r), 0.2 * std::sqrt(1.477e7 * m_e), 1e-12);
  EXPECT_NEAR(tooth_damping(0.1, 1.477e7, 0.0102, std::numeric_limits<double>::infinity(), r, r),
              0.2 * std::sqrt(1.477e7 * 0.0102 / (r * r)), 1e-12);
}

TEST(GearTeeth, StaticDeflection) {
  // k_m [[u + x_err]] = F cosα_n with F = T/(r cosβ cosα_n): the u_m row is zero there
  Case c = spur();
  c.data.stiffness = 1e4;
  c.data.backlash = 0.01;
  const auto element = c.build(Mat3::Identity());
  StateBuffer state(*element, {{1, c.x_a}, {2, c.x_b}});
  const double F = 8;
  state.multipliers[0] = F;
  state.scalars[2] = F * std::cos(20 * deg) / 1e4;
  EXPECT_NEAR(residual_of(*element, state)[14], 0, 1e-14);
  EXPECT_EQ(channel_of(*element, state, "CONTACT"), 1);
  state.multipliers[0] = -F;
  state.scalars[2] = -0.01 - F * std::cos(20 * deg) / 1e4;
  EXPECT_NEAR(residual_of(*element, state)[14], 0, 1e-13);
  EXPECT_EQ(channel_of(*element, state, "CONTACT"), -1);
}

TEST(GearTeeth, DefaultsOfTheCard) {
  Case c = spur();
  c.data.stiffness = 1e4;
  const auto teeth = [&](const BuildOptions& options = {}) {
    return dynamic_cast<const GearPair&>(*c.build(Mat3::Identity(), options)).teeth();
  };
  EXPECT_EQ(teeth().mode, ToothLaw::Damping::always);
  c.data.backlash = 0.02;
  EXPECT_EQ(teeth().mode, ToothLaw::Damping::contact);
  EXPECT_EQ(teeth().onset, 0);
  c.data.damping_mode = {"ALWAYS", {}};
  EXPECT_EQ(teeth().mode, ToothLaw::Damping::always);
  c.data.damping_ratio = 0.07;
  BuildOptions options;
  options.wheel_inertia = [](int node, const Vec3&) { return node == 1 ? 0.3 : 1.7; };
  EXPECT_NEAR(teeth(options).damping, tooth_damping(0.07, 1e4, 0.3, 1.7, 13 * 0.025, 29 * 0.025), 1e-12);
}

TEST(GearTeeth, BacklashInThreeWays) {
  Case c = helical();
  c.data.stiffness = 1e4;
  const auto backlash = [&] { return dynamic_cast<const GearPair&>(*c.build(Mat3::Identity())).teeth().backlash; };
  c.data.normal_backlash = 0.01;
  EXPECT_NEAR(backlash(), 0.01 / std::cos(20 * deg), 1e-16);
  c.data.normal_backlash = {};
  c.data.center_backlash = 0.003;  // taken up by moving the wheels together: twice what each flank then closes by
  const double helix = 23 * deg, alpha = std::atan(std::tan(20 * deg) / std::cos(helix));
  const double a0 = (21 + 34) * 0.02 / std::cos(helix), running = std::acos(a0 / (a0 - 0.003) * std::cos(alpha));
  const auto involute = [](double t) { return std::tan(t) - t; };
  EXPECT_NEAR(backlash(), 2 * std::cos(helix) * a0 * (involute(alpha) - involute(running)), 1e-14);
  EXPECT_NEAR(backlash(), 2 * 0.003 * std::tan(20 * deg), 2e-5) << "for small changes 2 Δa tan α_n";
  // inside a ring the teeth come closer when the centre distance grows
  c = internal();
  c.data.stiffness = 1e4;
  c.data.center_backlash = 0.003;
  const double ring_helix = 12 * deg, ring_alpha = std::atan(std::tan(20 * deg) / std::cos(ring_helix));
  const double a1 = (51 - 17) * 0.02 / std::cos(ring_helix), ring_running = std::acos(a1 / (a1 + 0.003) * std::cos(ring_alpha));
  EXPECT_NEAR(backlash(), 2 * std::cos(ring_helix) * a1 * (involute(ring_running) - involute(ring_alpha)), 1e-14);
  EXPECT_NEAR(backlash(), 2 * 0.003 * std::tan(20 * deg), 5e-5);
  c = bevel();
  c.data.stiffness = 1e4;
  c.data.center_backlash = 0.003;
  EXPECT_NEAR(backlash(), 0.006 * std::tan(20 * deg), 1e-16);
}

/// The first error message of a card that must not build.
std::string fault(const Case& c, const FunctionMap* functions = nullptr) {
  Diagnostics diagnostics;
  BuildOptions options;
  options.diagnostics = &diagnostics;
  options.functions = functions;
  const auto element = c.build(Mat3::Identity(), options);
  EXPECT_EQ(element, nullptr);
  for (const Diagnostic& d : diagnostics.all())
    if (d.severity == Severity::error) return d.message;
  return {};
}

TEST(GearTeeth, TablesMustRepeat) {
  Case c = spur();
  c.data.stiffness = 1e4;
  c.data.error = {"TABLE", {4}};
  FunctionMap functions;
  functions[4] = std::make_unique<ToothWave>(77);
  EXPECT_EQ(fault(c, &functions), "function 4 does not repeat with each turn of wheel A");
  functions[4] = std::make_unique<ToothWave>(360.0 / 13);
  EXPECT_NE(c.build(Mat3::Identity(), {.functions = &functions}), nullptr);
}

TEST(GearTeeth, FaultsOfTheCard) {
  Case c = spur();
  c.data.backlash = 0.1;
  EXPECT_EQ(fault(c), "JEU describes elastic teeth, but these are rigid");
  c.data.stiffness = 1;
  c.data.onset = 0.2;
  EXPECT_EQ(fault(c), "SMOOTH 0.2 is wider than the backlash 0.1");
  c.data.onset = {};
  c.data.damping_ratio = 0.1;
  EXPECT_NE(fault(c).find("XI needs the inertia of both wheels"), std::string::npos);
  c.data.damping = 0.1;
  EXPECT_EQ(fault(c), "both XI and CM are given: each fixes the damping of the teeth");
  c = spur();
  c.x_b *= 0.99;
  EXPECT_NE(fault(c).find("centre distance: 1.0395 given, 1.05 needed"), std::string::npos) << fault(c);
  c = spur();
  c.data.radii = {0.325, 0.7};
  EXPECT_EQ(fault(c), "pitch radius of wheel B: 0.7 given, 0.725 needed by 2 r cos(helix) = z m_n");
  c = internal();
  c.data.teeth = {17, 17};
  EXPECT_EQ(fault(c), "an internal pair with 17 teeth on both wheels");
  c = crossed();
  c.data.helix = {40, -35};
  EXPECT_NE(fault(c).find("axle of wheel B"), std::string::npos) << fault(c);
}

}  // namespace
}  // namespace engrane::elements::gears
