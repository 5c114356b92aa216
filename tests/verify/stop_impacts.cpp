// SPDX-License-Identifier: BSD-3-Clause
// A ball that bounces on a stop: order of position, velocity and times of impact with events, against flights in closed form and
// contacts by a fine Runge–Kutta rule; and the speeds after impacts without weight against Hunt and Crossley's closed form.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "elements/common/stop_law.hpp"
#include "run_deck.hpp"

namespace engrane::test {

using namespace elements;

namespace {

constexpr double mass = 2, gravity = 10, dropped = 0.45, ending = 1.5;

struct Law {
  std::string name, card;
  StopLaw law;
};

std::vector<Law> laws() {
  return {{"elastic", "K 4D3", {4e3, 1, 0, 0}},
          {"HUNT", "K 4D3 DAMP HUNT 0.1", {4e3, 1, 0.1, 0}},
          {"HUNT 1.5", "K 4D4 EXP 1.5 DAMP HUNT 0.1", {4e4, 1.5, 0.1, 0}},
          {"LINEAR", "K 4D3 DAMP LINEAR 20", {4e3, 1, 0, 20}}};
}

std::string ball(double h, const std::string& stop) {
  return fmt::format(R"(
.NOE
 I 1 X 0 0 {}
.MCE
 I 1 STOP N 0 1 NORMAL 0 0 1 {}
 I 2 INERTIA N 1 M {}
.CLM
 FIX NOEUD 1 C 1 2
 CHA NOEUD 1 C 3 V {}
.SAM TYPE DYNAMIC SCHEME CHUNG RHO 0.8 PREC 1e-12 EVENTS YES 1e-8
.SUB TF {} H {}
)",
                     dropped, stop, mass, -mass * gravity, ending, h);
}

struct Bounces {
  double z = 0, v = 0;
  std::vector<double> times;
};

/// Phases end where the height passes zero: flights by their formula, contacts by Runge–Kutta with steps halved at the end.
Bounces exact(const StopLaw& law) {
  Bounces out;
  double t = 0, z = dropped, v = 0;
  const auto step = [&](double z0, double v0, double h) {
    const auto a = [&](double x, double w) { return law.force(-x, -w, 0) / mass - gravity; };
    const double a1 = a(z0, v0), v2 = v0 + h / 2 * a1, a2 = a(z0 + h / 2 * v0, v2), v3 = v0 + h / 2 * a2,
                 a3 = a(z0 + h / 2 * v2, v3), v4 = v0 + h * a3, a4 = a(z0 + h * v3, v4);
    return std::array{z0 + h / 6 * (v0 + 2 * v2 + 2 * v3 + v4), v0 + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4)};
  };
  for (;;) {
    const double flight = (v + std::sqrt(v * v + 2 * gravity * z)) / gravity;
    if (t + flight >= ending) {
      const double rest = ending - t;
      out.z = z + v * rest - gravity / 2 * rest * rest;
      out.v = v - gravity * rest;
      return out;
    }
    t += flight;
    v -= gravity * flight;
    z = 0;
    out.times.push_back(t);
    for (double h = 2e-6; h > 1e-16;) {
      const auto [next, speed] = step(z, v, h);
      if (next >= 0 && z < 0) {
        h /= 2;
        continue;
      }
      z = next;
      v = speed;
      t += h;
    }
    z = 0;
    out.times.push_back(t);
  }
}

Bounces computed(double h, const std::string& stop) {
  DeckRun deck(ball(h, stop));
  Bounces out;
  const Configuration end = deck.run([&](const Configuration& c, const StepReport& report) {
    for (const Event& e : report.events)
      if (e.index == 0) out.times.push_back(c.time);
  });
  out.z = deck.node(end, 1).x[2];
  out.v = deck.node(end, 1).v[2];
  return out;
}

TEST(StopImpacts, KeepSecondOrder) {
  for (const Law& law : laws()) {
    const Bounces right = exact(law.law);
    ASSERT_GE(right.times.size(), 4u);
    std::vector<std::array<double, 3>> found;
    const std::array<double, 4> steps{0.004, 0.002, 0.001, 0.0005};
    for (const double h : steps) {
      const Bounces mine = computed(h, law.card);
      ASSERT_EQ(mine.times.size(), right.times.size()) << law.name << ", h = " << h;
      double worst = 0;
      for (std::size_t i = 0; i < right.times.size(); ++i) worst = std::max(worst, std::abs(mine.times[i] - right.times[i]));
      found.push_back({std::abs(mine.z - right.z), std::abs(mine.v - right.v), worst});
    }
    for (std::size_t what = 0; what < 3; ++what) {
      std::string line = fmt::format("{:9} {:9}", law.name, what == 0 ? "position" : what == 1 ? "velocity" : "times");
      for (const auto& errors : found) line += fmt::format("  {:.3e}", errors[what]);
      for (std::size_t i = 1; i < found.size(); ++i)
        line += fmt::format("  {:.2f}", std::log2(found[i - 1][what] / found[i][what]));
      fmt::print("{}\n", line);
      for (std::size_t i = 2; i < found.size(); ++i) {
        if (what < 2) {
          EXPECT_NEAR(std::log2(found[i - 1][what] / found[i][what]), 2, 0.15) << line;
          continue;
        }
        // a drift, which takes the place of steps shorter than h/100, may end that much behind the event
        EXPECT_LE(found[i][what], found[0][what] * std::pow(0.25, static_cast<double>(i)) * 1.15 + steps[i] / 100) << line;
      }
    }
  }
}

/// Between two walls without weight the speed v after an impact at u obeys d (u + v) = ln((1 + d u)/(1 − d v)).
TEST(StopImpacts, SpeedsFollowHuntAndCrossley) {
  const double d = 0.2;
  DeckRun deck(R"(
.NOE
 I 1 X 1 0 0
.MCE
 I 1 STOP N 0 1 MIN 0.9 MAX 1.1 K 1D4 EXP 1.5 DAMP HUNT 0.2
 I 2 INERTIA N 1 M 2
.CLM
 FIX NOEUD 1 C 2 3
.INI
 VIT NOEUD 1 C 1 V 3
.SAM TYPE DYNAMIC RHO 0.9 PREC 1e-12
.SUB TF 0.8 H 0.0002
)");
  std::vector<double> speeds;
  deck.run([&](const Configuration& c, const StepReport& report) {
    for (const Event& e : report.events)
      if (e.index % 2 == 0 && !e.rises) speeds.push_back(std::abs(deck.node(c, 1).v[0]));
  });
  ASSERT_GE(speeds.size(), 4u);
  double before = 3;
  for (const double after : speeds) {
    EXPECT_NEAR(d * (before + after), std::log((1 + d * before) / (1 - d * after)), 2e-5) << before << " " << after;
    before = after;
  }
}

constexpr double longest = 0.02;
constexpr double decay = 20, frequency = 150;  // of the contact

/// A ball that meets a damped stop at a speed of 1, in its sixth step when `part` of that has passed.
std::string damped_impact(double part, double tolerance = 1e-8) {
  return fmt::format(R"(
.NOE
 I 1 X 0 0 {}
.MCE
 I 1 STOP N 0 1 NORMAL 0 0 1 K {} DAMP LINEAR {}
 I 2 INERTIA N 1 M 1
.CLM
 FIX NOEUD 1 C 1 2
.INI
 VIT NOEUD 1 C 3 V -1
.SAM TYPE DYNAMIC SCHEME RADAU SOLVER KLU
.SUB TF 1 H {} TOL {}
)",
                     (5 + part) * longest, frequency * frequency + decay * decay, 2 * decay, longest, tolerance);
}

// Where a force jumps at an event, the speed after the impact does not depend on what part of a step was left to it. In a long
// drift over the event the force behind it had half of the time: 2e-3 of the speed, whatever TOL.
TEST(StopImpacts, WhatIsLeftOfAStepBeforeAnImpactDoesNotCount) {
  // Schwager and Poeschel, Granular Matter 9 (2007), p. 465: the contact ends where the force does
  const double contact =
      (std::numbers::pi - std::atan(2 * decay * frequency / (frequency * frequency - decay * decay))) / frequency;
  for (const double part : {0.001, 0.003, 0.005, 0.009, 0.02, 0.1, 0.5, 0.9, 0.995, 0.999}) {
    DeckRun deck(damped_impact(part));
    EXPECT_NEAR(deck.node(deck.run(), 1).v[2], std::exp(-decay * contact), 1e-8) << part;
  }
}

// A restart point may lie between a step and the drift across the event that it ends before.
TEST(StopImpacts, ArePassedWithTheSameBitsAfterARestart) {
  DeckRun whole(damped_impact(0.5, 1e-2));
  const auto scheme = make_scheme(whole.context());
  Runner runner(whole.context(), *scheme);
  std::vector<Snapshot> points;
  double speed = 0;
  const auto look = [&](const Configuration& c, const StepReport& step) {
    if (!step.last) runner.save(points.emplace_back());
    speed = whole.node(c, 1).v[2];
    return true;
  };
  runner.run(look, [](const StartReport&) {});
  for (const Snapshot& point : points) {
    DeckRun rest(damped_impact(0.5, 1e-2));
    const auto again = make_scheme(rest.context());
    double resumed = 0;
    Runner(rest.context(), *again).resume(point, [&](const Configuration& c, const StepReport&) {
      resumed = rest.node(c, 1).v[2];
      return true;
    });
    EXPECT_EQ(resumed, speed);
  }
}

}  // namespace
}  // namespace engrane::test
