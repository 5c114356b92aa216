// SPDX-License-Identifier: BSD-3-Clause
#include "elements/bearings/bearing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "elements/bearings/hertz.hpp"
#include "elements/bearings/rolling_elements.hpp"
#include "elements/suite.hpp"
#include "math/rotation.hpp"

namespace engrane::elements::bearings {
namespace {

using namespace suite;
using std::numbers::pi;
using Five = RollingElements::Five<double>;

const NodeMap places = {{0, Vec3::Zero()}, {1, {1, 0.2, -0.3}}, {2, {-0.5, 0.4, 0.8}}};

std::array<double, 3> list(const Vec3& v) { return {v[0], v[1], v[2]}; }

/// 36 values that couple everything but the spin, with an unsymmetric part and drag.
std::vector<double> film(double size, bool drag) {
  std::vector<double> values;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j)
      values.push_back((i == 3 || j == 3) ? (i == j && drag ? 0.7 * size : 0.0)
                                          : size * (i == j ? 5 + i : std::sin(1.0 + 3 * i + j)));
  return values;
}

BearingData placed(std::array<int, 2> ends, const Mat3& Q) {
  BearingData data;
  data.nodes = ends;
  data.at = list(Q * Vec3(0.3, -0.6, 0.2));
  data.axis = list(Q * Vec3(0.4, 1, 0.1));
  data.axis_2 = list(Q * Vec3(-0.2, 0.3, 1));
  return data;
}

Subject subject(const std::string& name, std::array<int, 2> ends, const std::function<void(BearingData&)>& fill) {
  Subject s;
  s.name = name;
  s.nodes = places;
  s.build = [=](const Mat3& Q) {
    BearingData data = placed(ends, Q);
    fill(data);
    return build(bearing_type(), data, turned(places, Q));
  };
  return s;
}

std::vector<double> both(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> all = a;
  all.insert(all.end(), b.begin(), b.end());
  return all;
}

TEST(Bearing, SuiteOfMatrices) {
  run_suite(subject("diagonal", {1, 2}, [](BearingData& d) { d.stiffness = {40, 50, 60, 0, 8, 9}; }));
  run_suite(subject("on the ground", {0, 2}, [](BearingData& d) { d.stiffness = {40, 50, 60, 0, 8, 9}; }));
  Subject s = subject("film", {1, 2}, [](BearingData& d) {
    d.stiffness = film(5, false);
    d.damping = film(0.4, true);
  });
  s.skip[Check::lagrange] = "an oil film has no potential";
  run_suite(s);
  s = subject("radial film", {2, 0}, [](BearingData& d) {
    d.stiffness = {20, 7, -6, 20};
    d.damping = {3, 0.1, 0.2, 4};
  });
  s.skip[Check::lagrange] = "an oil film has no potential";
  run_suite(s);
  s = subject("film by speed", {1, 2}, [](BearingData& d) {
    d.speeds = {-20, 0.1, 20};
    d.stiffness = both(film(5, false), both(film(6, false), film(9, false)));
    d.damping = both(film(0.1, true), both(film(0.4, true), film(0.2, true)));
  });
  s.skip[Check::lagrange] = "an oil film has no potential";
  run_suite(s);
}

/// The material of a deck.
std::vector<deck::Record> soft() {
  deck::MaterialCard card;
  card.young = {2000};
  card.poisson = {0.3};
  deck::Record record;
  record.id = 1;
  record.data = card;
  return {record};
}

Subject rolling(const std::string& name, std::array<int, 2> ends, const std::function<void(BearingData&)>& fill) {
  Subject s = subject(name, ends, {});
  s.build = [=](const Mat3& Q) {
    static const std::vector<deck::Record> records = soft();
    BearingData data = placed(ends, Q);
    data.material = 1;
    data.diameter = 0.8;
    data.pitch_diameter = 4;
    fill(data);
    return build(bearing_type(), data, turned(places, Q), {.records = &records});
  };
  s.length = 0.2;
  s.turn = 0.3;
  s.tolerance = 1e-6;  // the law bends sharply where an element begins to carry
  return s;
}

TEST(Bearing, SuiteOfRollingElements) {
  run_suite(rolling("balls", {1, 2}, [](BearingData& d) { d.balls = 7; }));
  run_suite(rolling("balls with play", {2, 0}, [](BearingData& d) {
    d.balls = 7;
    d.clearance = 0.01;
  }));
  Subject s = rolling("balls at an angle, damped", {1, 2}, [](BearingData& d) {
    d.balls = 7;
    d.contact_angle = 35;
    d.damping = {3, 2, 2, 0.1, 1, 1};
  });
  s.skip[Check::lagrange] = "a damper has no potential";
  run_suite(s);
  s = rolling("balls under thrust", {0, 2}, [](BearingData& d) {
    d.balls = 7;
    d.contact_angle = 35;
    d.preload = 3;
  });
  s.skip[Check::zero] = s.skip[Check::rigid] = "it is loaded in the reference configuration";
  run_suite(s);
  run_suite(rolling("rollers", {1, 2}, [](BearingData& d) {
    d.rollers = 5;
    d.length = 0.9;
    d.slices = 3;
    d.clearance = -2;  // all carry: where a slice begins to, the tangent has an edge that differences do not see
  }));
  run_suite(rolling("tapered rollers", {1, 2}, [](BearingData& d) {
    d.rollers = 5;
    d.length = 0.9;
    d.slices = 3;
    d.contact_angle = 17;
  }));
}

TEST(Bearing, Extremes) {
  run_extreme(subject("stiff film", {1, 2}, [](BearingData& d) {
    d.stiffness = film(1e14, false);
    d.damping = film(1e-9, true);
  }));
  run_extreme(rolling("many balls", {1, 2}, [](BearingData& d) {
    d.balls = 15;
    d.clearance = 1e-9;
  }));
}

/// A sphere on a plane: Q = 4/3 E* √R δ^1.5 and p₀³ = 6 Q E*²/(π³ R²) (Johnson, eqs. 4.23 and 4.24).
TEST(Hertz, IsThatOfSpheres) {
  for (const double R : {1e-3, 0.7, 1e4})
    for (const double unround : {0.0, 1e-13, 1e-9}) {
      const PointContact sphere = point_contact(1 / R, (1 + unround) / R, 3e5);
      EXPECT_NEAR(sphere.stiffness / (4.0 / 3 * 3e5 * std::sqrt(R)), 1, 2e-8) << R;
      EXPECT_NEAR(sphere.pressure / std::cbrt(6 * 3e5 * 3e5 / (pi * pi * pi * R * R)), 1, 2e-8) << R;
    }
}

/// The surface under a pressure √(1 − x² − y²/k²) is δ − A x² − B y² (Johnson, eq. 3.37), integrals that need no ellipse to be
/// found.
TEST(Hertz, IsThatOfEllipses) {
  for (const double k : {0.999, 0.9, 0.5, 0.1, 0.01}) {
    const auto integral = [&](const auto& f) {
      double sum = 0;
      constexpr int points = 4000;  // of the midpoint rule over a quarter of a period
      for (int i = 0; i < points; ++i) {
        const double c = std::cos((i + 0.5) * pi / 2 / points), round = c * c + k * k * (1 - c * c);
        sum += f(c * c, round) / std::sqrt(round) * pi / 2 / points;
      }
      return sum;
    };
    const double approach = k * integral([](double, double) { return 1.0; });
    const double A = k * integral([](double c2, double round) { return c2 / round; });
    const double B = integral([](double c2, double) { return c2; }) / k;
    const double load = 2 * pi * k / 3;
    for (const bool swapped : {false, true}) {
      const PointContact contact = point_contact(swapped ? 2 * B : 2 * A, swapped ? 2 * A : 2 * B, 1);
      EXPECT_NEAR(contact.stiffness * std::pow(approach, 1.5) / load, 1, 1e-9) << k;
      EXPECT_NEAR(contact.pressure * std::cbrt(load), 1, 1e-9) << k;
    }
  }
}

RollingData deep_groove() {
  RollingData d;
  d.count = 9;
  d.diameter = 12.7e-3;
  d.pitch_diameter = 65e-3;
  d.inner_conformity = d.outer_conformity = 0.52;
  d.young = 206e9;
  d.poisson = 0.3;
  return d;
}

/// The radial load that makes one largest load, without play: Z Qmax/2π ∫ cosⁿ⁺¹ over the loaded half (Sjövall's integral), 4.37
/// of Stribeck for balls and 4.08 for rollers.
TEST(RollingElements, DistributionOfRadialLoad) {
  for (const bool balls : {true, false}) {
    RollingData d = deep_groove();
    d.balls = balls;
    d.count = 2001;                                  // so many that the sum is the integral
    d.inner_conformity = d.outer_conformity = 0.95;  // the direction of contact does not turn
    d.length = 0.01;
    d.crowned = false;
    d.slices = 2;
    const RollingElements elements(d);
    const Five q = {0, 1e-7, 0, 0, 0};
    const double n = balls ? 1.5 : 10.0 / 9;
    const double integral = std::tgamma(1 + n / 2) / (2 * std::sqrt(pi) * std::tgamma(1.5 + n / 2));
    EXPECT_NEAR(elements.load(q, 0)[1] / (d.count * elements.loads(q).force), integral, 1e-6);
    EXPECT_NEAR(1 / integral, balls ? 4.37 : 4.08, 0.005);
    EXPECT_EQ(elements.loads(q).loaded, 1001);
  }
}

/// Thrust on balls at an angle (Harris and Kotzalas, ch. 7): Q = K A^1.5 (cos α₀/cos α − 1)^1.5, F = Z Q sin α, and the approach
/// is A (cos α₀ tan α − sin α₀).
TEST(RollingElements, ThrustOpensTheContactAngle) {
  RollingData d = deep_groove();
  for (const double angle : {0.2, 0.7}) {
    d.contact_angle = angle;
    const RollingElements elements(d);
    const double A = 0.04 * d.diameter;
    const double K = elements.loads({std::sin(angle) * 1e-9, std::cos(angle) * 1e-9, 0, 0, 0}).force / std::pow(1e-9, 1.5);
    for (const double opened : {angle + 1e-4, angle + 0.05}) {
      const double Q = K * std::pow(A * (std::cos(angle) / std::cos(opened) - 1), 1.5);
      const double approach = A * (std::cos(angle) * std::tan(opened) - std::sin(angle));
      EXPECT_NEAR(elements.load(Five{approach, 0, 0, 0, 0}, 0)[0] / (d.count * Q * std::sin(opened)), 1, 1e-6);
      EXPECT_NEAR(elements.loads({approach, 0, 0, 0, 0}).force / Q, 1, 1e-6);
      // as a preload it is there from the start
      RollingData loaded = d;
      loaded.preload = d.count * Q * std::sin(opened);
      EXPECT_NEAR(RollingElements(loaded).preload_approach() / approach, 1, 1e-6);
      EXPECT_NEAR(RollingElements(loaded).load(Five{}, 0)[0] / loaded.preload, 1, 1e-10);  // A - A0 is rounded
    }
  }
}

/// The play of a deep groove bearing lets it move along its axis until it touches at cos α = 1 − P/2A.
TEST(RollingElements, PlayAcrossIsPlayAlong) {
  RollingData d = deep_groove();
  d.clearance = 20e-6;
  const RollingElements elements(d);
  const double A = 0.04 * d.diameter, free = std::acos(1 - d.clearance / (2 * A));
  EXPECT_NEAR(elements.contact_angle(), free, 1e-12);
  const double along = A * std::sin(free);
  for (const double sign : {-1.0, 1.0}) {
    EXPECT_EQ(elements.load(Five{0.9999 * sign * along, 0, 0, 0, 0}, 0)[0], 0);
    EXPECT_GT(sign * elements.load(Five{1.0001 * sign * along, 0, 0, 0, 0}, 0)[0], 0);
    EXPECT_EQ(elements.load(Five{0, 0.9999 * sign * 10e-6 / (sign > 0 ? 1 : std::cos(pi / 9)), 0, 0, 0}, 0)[1], 0);
  }
  EXPECT_GT(elements.load(Five{0, 1.0001 * 10e-6, 0, 0, 0}, 0)[1], 0);
}

/// Rollers by ISO/TS 16281: Q = 35948 L^(8/9) δ^(10/9), N and mm, of steel; under tilt the middles of the slices.
TEST(RollingElements, RollersOfTheStandard) {
  RollingData d = deep_groove();
  d.balls = false;
  d.length = 10e-3;
  d.crowned = false;
  d.count = 1;
  RollingElements straight(d);
  EXPECT_NEAR(straight.load(Five{0, 5e-6, 0, 0, 0}, 0)[1] / (35948 * std::pow(10, 8.0 / 9) * std::pow(5e-3, 10.0 / 9)), 1, 1e-12);
  // line contact: p₀² = w E*/(π R) on the inner ring
  const double w = straight.load(Five{0, 5e-6, 0, 0, 0}, 0)[1] / d.length, modulus = 206e9 / (2 * 0.91);
  const double gamma = d.diameter / d.pitch_diameter, R = d.diameter / 2 * (1 - gamma);
  EXPECT_NEAR(straight.loads({0, 5e-6, 0, 0, 0}).pressure / std::sqrt(w * modulus / (pi * R)), 1, 1e-12);
  // the moment of a roller that tilts without load: half its length presses, at distances from its middle
  d.slices = 1000;
  const double tilt = 1e-3, c = 35948e6 * std::pow(d.length, -1.0 / 9) * std::pow(tilt, 10.0 / 9);
  const double moment = c * std::pow(d.length / 2, 28.0 / 9) * 9 / 28;
  EXPECT_NEAR(RollingElements(d).load(Five{0, 0, 0, 0, tilt}, 0)[4] / moment, 1, 1e-4);
  // crowning takes load from the ends
  d.crowned = true;
  EXPECT_LT(RollingElements(d).load(Five{0, 5e-6, 0, 0, 0}, 0)[1], straight.load(Five{0, 5e-6, 0, 0, 0}, 0)[1]);
}

TEST(Bearing, LetsTheShaftSpin) {
  BearingData data;
  data.nodes = {1, 2};
  data.axis = {0, 0, 1};
  data.axis_2 = {{1, 0, 0}};
  data.stiffness = {10, 20, 30, 0, 5, 6};
  data.damping = {0, 0, 0, 0.5, 0, 0};
  const NodeMap nodes = {{1, Vec3::Zero()}, {2, Vec3::Zero()}};
  const auto bearing = build(bearing_type(), data, nodes);
  StateBuffer state(*bearing, nodes);
  // the housing turned a quarter about z, the shaft anyhow about the axis, and tilted about the housing's axis 2
  const Mat3 quarter = rotation_exp({0, 0, pi / 2});
  for (const double angle : {0.0, 2.0, 5.0}) {
    state.turn(0, quarter, Vec3::Zero());
    state.turn(1, quarter * rotation_exp({0.01, 0, 0}) * rotation_exp({0, 0, angle}), Vec3::Zero());
    state.nodes[1].x = {0, 0.3, 0.2};
    state.nodes[1].W = {0, 0, 4};
    EXPECT_NEAR(channel_of(*bearing, state, "DISPLACEMENT_1"), 0.2, 1e-15);
    EXPECT_NEAR(channel_of(*bearing, state, "DISPLACEMENT_2"), 0.3, 1e-15);
    EXPECT_NEAR(channel_of(*bearing, state, "FORCE_1"), -2, 1e-14);
    EXPECT_NEAR(channel_of(*bearing, state, "FORCE_2"), -6, 1e-14);
    EXPECT_NEAR(channel_of(*bearing, state, "TILT_2"), std::sin(0.01), 1e-15);
    EXPECT_NEAR(channel_of(*bearing, state, "MOMENT_2"), -5 * std::sin(0.01) * std::cos(0.01), 1e-14);
    EXPECT_NEAR(channel_of(*bearing, state, "SPEED"), 4 * std::cos(0.01), 1e-14);
    EXPECT_NEAR(channel_of(*bearing, state, "MOMENT_1"), -0.5 * 4 * std::cos(0.01), 1e-14);
  }
}

TEST(Bearing, MatricesFollowTheSpeed) {
  BearingData data;
  data.nodes = {0, 2};
  data.axis = {0, 0, 1};
  data.axis_2 = {{1, 0, 0}};
  data.speeds = {100, 300};
  data.stiffness = {20, 4, -4, 20, 60, 8, -8, 60};
  const NodeMap nodes = {{0, Vec3::Zero()}, {2, Vec3::Zero()}};
  const auto bearing = build(bearing_type(), data, nodes);
  StateBuffer state(*bearing, nodes);
  state.nodes[1].x = {0.1, 0, 0};
  for (const auto& [speed, direct, cross] :
       {std::tuple{-50.0, 20.0, 4.0}, {100.0, 20.0, 4.0}, {150.0, 30.0, 5.0}, {900.0, 60.0, 8.0}}) {
    state.nodes[1].W = {0, 0, speed};
    EXPECT_NEAR(channel_of(*bearing, state, "FORCE_2"), -0.1 * direct, 1e-14) << speed;
    EXPECT_NEAR(channel_of(*bearing, state, "FORCE_3"), 0.1 * cross, 1e-14) << speed;
  }
}

TEST(Bearing, SwitchesAndTheirRates) {
  const auto fill = [](BearingData& d) {
    d.speeds = {-20, 0.1, 20};
    d.damping = both(film(0.1, true), both(film(0.4, true), film(0.2, true)));
  };
  for (const Subject& s : {rolling("balls", {1, 2},
                                   [&](BearingData& d) {
                                     d.balls = 7;
                                     fill(d);
                                   }),
                           rolling("rollers", {1, 2}, [&](BearingData& d) {
                             d.rollers = 7;
                             d.length = 0.9;
                             d.slices = 3;
                             fill(d);
                           })}) {
    const auto bearing = s.build(Mat3::Identity());
    ASSERT_EQ(bearing->layout().switches.size(), 11u);  // the whole bearing, each element, each speed
    Random random(5);
    const StateBuffer state = random_state(s, *bearing, random);
    const auto at = [&](double t) {
      std::array<Switch, 11> values;
      bearing->switches(state.after(t).view(), values);
      return values;
    };
    const double h = 1e-5;
    const auto now = at(0), plus = at(h), minus = at(-h);
    double most = -1;
    for (std::size_t i = 0; i < now.size(); ++i) {
      EXPECT_NEAR(now[i].rate, (plus[i].value - minus[i].value) / (2 * h), 1e-6 * (1 + std::abs(now[i].rate))) << s.name << i;
      if (i > 0 && i <= 7) most = std::max(most, now[i].value);
    }
    EXPECT_EQ(now[0].value, most);
  }
}

TEST(Bearing, FaultsOfTheCard) {
  static const std::vector<deck::Record> records = soft();
  const auto message = [&](const BearingData& data) {
    Diagnostics diagnostics;
    EXPECT_EQ(build(bearing_type(), data, places, {.diagnostics = &diagnostics, .records = &records}), nullptr);
    std::string all;
    for (const Diagnostic& d : diagnostics.all()) all += (all.empty() ? "" : "; ") + d.message;
    return all;
  };
  BearingData plain;
  plain.nodes = {1, 2};
  plain.axis = {0, 0, 1};
  BearingData data = plain;
  EXPECT_EQ(message(data), "a bearing with neither rolling elements nor a matrix does nothing");
  data.stiffness = {1, 1, 1, 1, 1, 1};
  EXPECT_EQ(message(data), "K resists rotation about the axis, which a bearing leaves free");
  data.stiffness = {1, 1, 1, 0, -1, 1};
  EXPECT_EQ(message(data), "the matrix of K is not positive: some motion would gain energy from it");
  data.stiffness = {1, 1, 1, 0, 1};
  EXPECT_EQ(message(data), "K has 5 values for 1 matrix");
  data.speeds = {1, 2, 3};
  EXPECT_EQ(message(data), "K has 5 values for 3 speeds");
  data.speeds = {1, 1};
  EXPECT_EQ(message(data), "SPEED 1 follows 1");
  data = plain;
  data.stiffness = {1, 0, 0, 1};
  data.diameter = 1;
  EXPECT_EQ(message(data), "D has no effect without BALLS or ROLLERS");
  data = plain;
  data.balls = 9;
  EXPECT_EQ(message(data), "BALLS without D; BALLS without DM; BALLS without MAT");
  data.diameter = 1;
  data.pitch_diameter = 2;
  data.material = 7;
  EXPECT_EQ(message(data), "material 7 does not exist");
  data.material = 1;
  EXPECT_EQ(message(data), "9 elements of 1 overlap on a circle of 2");
  data.balls = 3;
  data.contact_angle = 17;
  data.clearance = 0.01;
  EXPECT_EQ(message(data), "CLEARANCE beside ALPHA: balls that touch at an angle have no play");
  data.contact_angle.reset();
  data.clearance = 0.2;
  EXPECT_EQ(message(data), "a play of 0.2 is more than the grooves allow");
  data.clearance.reset();
  data.length = 1;
  data.stiffness = {1, 0, 0, 1};
  EXPECT_EQ(message(data), "K has no effect beside BALLS; L has no effect beside BALLS");
  data = plain;
  data.rollers = 4;
  data.diameter = 3;
  data.pitch_diameter = 2;
  data.material = 1;
  EXPECT_EQ(message(data), "ROLLERS without L");
  data.length = 1;
  data.preload = 5;
  EXPECT_EQ(message(data),
            "elements of 3 are no smaller than their circle of 2; PRELOAD of cylindrical rollers, which take no thrust");
}

}  // namespace
}  // namespace engrane::elements::bearings
