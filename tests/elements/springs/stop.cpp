// SPDX-License-Identifier: BSD-3-Clause
#include "elements/springs/stop.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "elements/common/stop_law.hpp"
#include "elements/springs/places.hpp"
#include "elements/suite.hpp"
#include "math/rotation.hpp"

namespace engrane::elements::springs {
namespace {

using namespace suite;

enum class Kind { distance, angle, height };

/// Limits so far out that every state is pressed against them (`pressed`) or against none.
Subject subject(Kind kind, std::array<int, 2> ends, double exponent, const deck::Tagged& damping, bool pressed, bool upper) {
  Subject s;
  s.name = (kind == Kind::distance ? "distance"
            : kind == Kind::angle  ? "angle"
                                   : "height") +
           (" DAMP " + damping.tag) + (pressed ? "" : " open");
  s.nodes = places;
  const auto make = [=](std::array<int, 2> order, const Mat3& Q) {
    StopData data;
    data.nodes = order;
    if (kind == Kind::angle) data.axis = list(Q * Vec3(0.3, -0.5, 0.7));
    if (kind == Kind::height) {
      data.normal = list(Q * Vec3(0.2, 0.5, -0.8));
      data.on = list(Q * Vec3(0.1, 0.4, -0.2));
      data.at = list(Q * Vec3(-0.3, 0.1, 0.6));
    }
    const double far = kind == Kind::angle ? 300 : 20;
    const bool up = kind == Kind::angle && order != ends ? !upper : upper;  // the angle of A from B is the opposite one
    (up ? data.upper : data.lower) = up == pressed ? -far : far;
    data.stiffness = 40;
    data.exponent = exponent;
    data.damping = damping;
    return build(stop_type(), data, turned(places, Q));
  };
  s.build = [=](const Mat3& Q) { return make(ends, Q); };
  if (kind != Kind::height) s.build_swapped = [=] { return make({ends[1], ends[0]}, Mat3::Identity()); };
  s.step = 1e-4;
  s.tolerance = 1e-7;
  if (pressed)
    for (const Check check : {Check::zero, Check::rigid})
      s.skip[check] = "the reference configuration is pressed against the stop";
  if (damping.given()) s.skip[Check::lagrange] = "a damper has no potential";
  return s;
}

TEST(Stop, Suite) {
  for (const Kind kind : {Kind::distance, Kind::angle, Kind::height})
    for (const double exponent : {1.0, 1.5, 2.2})
      for (const bool upper : {false, true}) {
        if (kind == Kind::distance && upper) continue;  // no length is above −20: see UpperLimitOfALength
        run_suite(subject(kind, {1, 2}, exponent, {}, true, upper));
        run_suite(subject(kind, {1, 2}, exponent, {"HUNT", {0.03}}, true, upper));
        run_suite(subject(kind, {0, 2}, exponent, {"LINEAR", {2}}, true, upper));
        run_suite(subject(kind, {1, 2}, exponent, {"HUNT", {0.03}}, false, upper));
      }
}

TEST(Stop, Extremes) {
  for (const Kind kind : {Kind::distance, Kind::angle, Kind::height})
    for (const bool pressed : {true, false}) run_extreme(subject(kind, {1, 2}, 1.5, {"HUNT", {1e6}}, pressed, false));
}

TEST(Stop, UpperLimitOfALength) {
  StopData data;
  data.nodes = {1, 2};
  data.upper = 3;
  data.stiffness = 100;
  data.exponent = 1.5;
  const NodeMap nodes = {{1, Vec3::Zero()}, {2, {0, 3, 4}}};
  const auto stop = build(stop_type(), data, nodes);
  StateBuffer state(*stop, nodes);
  EXPECT_NEAR(channel_of(*stop, state, "GAP"), -2, 1e-14);
  EXPECT_NEAR(channel_of(*stop, state, "FORCE"), -100 * std::pow(2, 1.5), 1e-12) << "it pulls the length down";
  EXPECT_NEAR(channel_of(*stop, state, "SPRING_ENERGY"), 100 * std::pow(2, 2.5) / 2.5, 1e-12);
  EXPECT_NEAR(residual_of(*stop, state)[8], 100 * std::pow(2, 1.5) * 0.8, 1e-12);
}

TEST(Stop, NeverPulls) {
  for (const StopLaw& law : {StopLaw{100, 1, 0.5, 0}, StopLaw{100, 1.5, 0.5, 0}, StopLaw{100, 1, 0, 7}})
    for (const double pressed : {-1.0, -1e-9, 0.0, 1e-9, 0.1, 3.0})
      for (const double rate : {-100.0, -2.1, -1.0, 0.0, 1.0, 100.0}) {
        const double force = law.force(pressed, rate, 0);
        EXPECT_GE(force, 0);
        if (pressed <= 0) {
          EXPECT_EQ(force, 0);
          continue;
        }
        EXPECT_EQ(force > 0, law.pressure(pressed, rate) > 0) << pressed << " " << rate;
      }
}

TEST(Stop, HuntAndCrossleyLoseAsMuchAsTheRestitutionSays) {
  for (const double e : {0.05, 0.3, 0.8, 0.99, 0.9999})
    for (const double exponent : {1.0, 1.5, 2.0}) {
      const double speed = 2, mass = 0.7;
      const StopLaw law{500, exponent, StopLaw::hunt_of_restitution(e, speed), 0};
      // Runge–Kutta through the contact; the last step is cut where it parts
      double x = 0, v = speed;
      const auto pull = [&](double pressed, double rate) { return -law.force(pressed, rate, 0) / mass; };
      const double h = 2e-6;
      for (;;) {
        const double a1 = pull(x, v), v2 = v + h / 2 * a1, a2 = pull(x + h / 2 * v, v2), v3 = v + h / 2 * a2,
                     a3 = pull(x + h / 2 * v2, v3), v4 = v + h * a3, a4 = pull(x + h * v3, v4);
        const double next = x + h / 6 * (v + 2 * v2 + 2 * v3 + v4);
        if (next < 0) break;
        x = next;
        v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
      }
      EXPECT_NEAR(-v, e * speed, 1e-7 * speed) << "e " << e << ", exponent " << exponent;
    }
  // Hunt and Crossley's own estimate for little damping: e = 1 − (2/3) d v
  EXPECT_NEAR(StopLaw::hunt_of_restitution(1 - 1e-6, 3), 1.5e-6 / 3, 1e-12);
  EXPECT_EQ(StopLaw::hunt_of_restitution(1, 3), 0);
}

TEST(Stop, SwitchesAndTheirRates) {
  for (const Kind kind : {Kind::distance, Kind::angle, Kind::height})
    for (const deck::Tagged& damping : {deck::Tagged{"HUNT", {0.03}}, {"LINEAR", {2}}}) {
      const Subject s = subject(kind, {1, 2}, 1.5, damping, true, false);
      const auto stop = s.build(Mat3::Identity());
      ASSERT_EQ(stop->layout().switches.size(), 2u);
      Random random(5);
      const StateBuffer state = random_state(s, *stop, random);
      const auto at = [&](double t) {
        std::array<Switch, 2> values;
        stop->switches(state.after(t).view(), values);
        return values;
      };
      const double h = 1e-4;
      for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_GT(at(0)[i].size, 0);
        EXPECT_NEAR(at(0)[i].rate, (at(h)[i].value - at(-h)[i].value) / (2 * h), 1e-5 * (1 + std::abs(at(0)[i].rate)));
      }
    }
}

TEST(Stop, FaultsOfTheCard) {
  const auto message = [&](const StopData& data) {
    Diagnostics diagnostics;
    EXPECT_EQ(build(stop_type(), data, places, {.diagnostics = &diagnostics}), nullptr);
    return diagnostics.all().empty() ? std::string() : diagnostics.all().front().message;
  };
  StopData data;
  data.nodes = {1, 2};
  data.stiffness = 1;
  EXPECT_EQ(message(data), "a stop without limits");
  data.lower = 2;
  data.upper = 1;
  EXPECT_EQ(message(data), "MAX 1 is below MIN 2");
  data.upper.reset();
  data.on = {{0, 0, 0}};
  EXPECT_EQ(message(data), "ON has no meaning for a stop on a distance");
  data.axis = {{0, 0, 1}};
  EXPECT_EQ(message(data), "ON has no meaning for a stop on an angle");
  data.normal = {{0, 0, 1}};
  EXPECT_EQ(message(data), "AXIS and NORMAL both say what is limited");
  data.axis.reset();
  data.damping = {"REST", {1.2, 1}};
  EXPECT_EQ(message(data), "REST 1.2 1: no coefficient of restitution at a speed of impact");
  data.damping = {"HUNT", {-1}};
  EXPECT_EQ(message(data), "damping must not be negative");
}

}  // namespace
}  // namespace engrane::elements::springs
