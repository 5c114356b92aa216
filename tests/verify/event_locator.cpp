// SPDX-License-Identifier: BSD-3-Clause
// The locator of events by itself: an element whose switch is a known function of time, and an analysis that knows it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>

#include "solve/run/runner.hpp"

namespace engrane::test {

using namespace solve;

namespace {

/// Its switch is the x of its node.
class Gauge final : public Element {
 public:
  explicit Gauge(int node) : Element(node) {
    layout_.nodes = {node};
    layout_.needs = {NodeNeed::translation};
    layout_.switches = {{"opens", "closes"}};
  }
  const Layout& layout() const override { return layout_; }
  void residual(const State&, std::span<double> r) const override { std::fill(r.begin(), r.end(), 0.0); }
  void tangent(const State& state, Weights, std::span<double> r, std::span<double> k) const override {
    residual(state, r);
    std::fill(k.begin(), k.end(), 0.0);
  }
  void constraint_rates(const State&, std::span<double>, std::span<double>, std::span<double>) const override {}
  void switches(const State& state, std::span<Switch> values) const override {
    values[0] = {state.nodes[0].x[0], state.nodes[0].v[0], 1};
  }

 private:
  Layout layout_;
};

struct Curve {
  std::function<double(double)> value, rate;
};

/// Moves node i along the curve i.
class Told final : public Scheme {
 public:
  Told(SolverContext& context, std::vector<Curve> curves) : Scheme(context), curves_(std::move(curves)) {}
  StartReport start(Configuration& c) override {
    set(c, c.time);
    return {};
  }
  Outcome attempt(const Configuration& from, double h, Configuration& to) override {
    ++attempts;
    to = from;
    set(to, from.time + h);
    Outcome outcome;
    outcome.newton.converged = !fails || !fails(from.time, to.time);
    return outcome;
  }
  bool meets_events() const override { return true; }
  void drift(Configuration& c, double h) override {
    set(c, c.time + h);
    if (!drifted) return;
    drifted(c.time);
    set(c, c.time);
  }

  int attempts = 0;
  std::function<bool(double, double)> fails;  ///< steps, from and to, that have no solution
  std::function<void(double)> drifted;

 private:
  void set(Configuration& c, double time) const {
    c.time = time;
    for (std::size_t i = 0; i < curves_.size(); ++i) {
      c.nodes[i + 1].x[0] = curves_[i].value(time);
      c.nodes[i + 1].v[0] = curves_[i].rate(time);
    }
  }
  std::vector<Curve> curves_;
};

struct Seen {
  struct At {
    double time;
    int part;
    bool rises;
  };
  std::vector<At> events;
  std::vector<double> regular;
  int chatter = 0, locating = 0, attempts = 0;
};

Seen follow(std::vector<Curve> curves, double end, double h, std::function<bool(double, double)> fails = {},
            std::function<void(double)> drifted = {}) {
  Model model;
  model.nodes.resize(curves.size() + 1);
  for (std::size_t i = 1; i < model.nodes.size(); ++i) {
    const int index = static_cast<int>(i);
    model.nodes[i].id = index;
    Model::Part part;
    part.element = std::make_unique<Gauge>(index);
    part.type = "GAUGE";
    part.nodes = {index};
    model.parts.push_back(std::move(part));
  }
  SolverOptions options;
  options.analysis = SolverOptions::Analysis::dynamics;
  options.end = end;
  options.step = h;
  SolverContext context(model, options, PETSC_COMM_SELF);
  Told told(context, std::move(curves));
  told.fails = std::move(fails);
  told.drifted = std::move(drifted);
  Seen seen;
  Runner(context, told)
      .run(
          [&](const Configuration& c, const StepReport& step) {
            for (const Event& e : step.events) seen.events.push_back({c.time, e.part, e.rises});
            if (step.regular) seen.regular.push_back(c.time);
            seen.chatter += step.chatter;
            seen.locating += step.locating;
            return true;
          },
          [](const StartReport&) {});
  seen.attempts = told.attempts;
  return seen;
}

TEST(FirstDescent, IsThatOfTheCubic) {
  // −(s − 0.25)(s − 0.5)(s − 2): positive at 0, below zero between the first two roots, positive again at 1
  const auto p = [](double s) { return -(s - 0.25) * (s - 0.5) * (s - 2); };
  const auto rate = [](double s) { return -((s - 0.5) * (s - 2) + (s - 0.25) * (s - 2) + (s - 0.25) * (s - 0.5)); };
  const double h = 0.1;
  const auto found = first_descent(p(0), rate(0) / h, p(1), rate(1) / h, h, 0);
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(*found, 0.25 * h, 1e-15);
}

TEST(FirstDescent, SeesADipBetweenPositiveEnds) {
  const auto p = [](double t) { return (t - 0.3) * (t - 0.4); };
  const auto found = first_descent(p(0), -0.7, p(1), 1.3, 1, 0);
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(*found, 0.3, 1e-14);
  EXPECT_FALSE(first_descent(p(0) + 0.0026, -0.7, p(1) + 0.0026, 1.3, 1, 0).has_value()) << "a dip that stays above zero";
  EXPECT_FALSE(first_descent(0, 1, 1, 1, 1, 0).has_value()) << "zero at the beginning, and rising";
}

TEST(EventLocator, FindsEveryCrossingAndKeepsTheGrid) {
  const double w = 2 * std::numbers::pi;
  const Seen seen =
      follow({{[w](double t) { return std::cos(w * t); }, [w](double t) { return -w * std::sin(w * t); }}}, 3, 0.07);
  ASSERT_EQ(seen.events.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(seen.events[i].time, 0.25 + 0.5 * static_cast<double>(i), 2e-6 * 0.07);
    EXPECT_EQ(seen.events[i].rises, i % 2 == 1);
  }
  ASSERT_EQ(seen.regular.size(), 44u);  // the start, 42 multiples of H, and the end
  for (std::size_t i = 0; i < 43; ++i) EXPECT_NEAR(seen.regular[i], 0.07 * static_cast<double>(i), 1e-12);
  EXPECT_LE(seen.locating, 18) << "three attempts for each should do";
  EXPECT_EQ(seen.chatter, 0);
}

TEST(EventLocator, SeesAPhaseShorterThanTheStep) {
  // positive but for 0.49 < t < 0.51, within the second step
  const Seen seen = follow({{[](double t) { return (t - 0.49) * (t - 0.51); }, [](double t) { return 2 * t - 1; }}}, 1.2, 0.4);
  ASSERT_EQ(seen.events.size(), 2u);
  EXPECT_NEAR(seen.events[0].time, 0.49, 1e-6);
  EXPECT_NEAR(seen.events[1].time, 0.51, 1e-6);
}

TEST(EventLocator, TheEarliestOfSeveralComesFirst) {
  const auto line = [](double zero) { return Curve{[zero](double t) { return t - zero; }, [](double) { return 1.0; }}; };
  const Seen seen = follow({line(0.73), line(0.31), line(0.73), line(1)}, 2, 1);
  ASSERT_EQ(seen.events.size(), 4u);
  const double times[] = {0.31, 0.73, 0.73, 1};
  const int parts[] = {1, 0, 2, 3};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(seen.events[i].time, times[i], 2e-6);
    EXPECT_EQ(seen.events[i].part, parts[i]);
  }
  EXPECT_EQ(seen.regular, (std::vector<double>{0, 1, 2}));
}

TEST(EventLocator, StepsThatHaveNoSolutionAreMetByAnEvent) {
  // as where a force jumps: no step that begins before the event ends soon after it
  const auto fails = [](double from, double to) { return from < 0.71 && to > 0.71 && to < 0.8; };
  const Seen seen = follow({{[](double t) { return t - 0.71; }, [](double) { return 1.0; }}}, 2, 0.75, fails);
  ASSERT_EQ(seen.events.size(), 1u);
  EXPECT_NEAR(seen.events[0].time, 0.71, 2e-6);
}

TEST(EventLocator, ChatteringEndsAndIsToldOnce) {
  // a switch that turns back as soon as it is passed, as dry friction without rounding would
  double side = 1, since = 0;
  const Curve sticky{[&](double t) { return side * (0.02 - (t - since)); }, [&](double) { return -side; }};
  const auto turn = [&](double t) {
    if (t - since <= 0.02) return;
    side = -side;
    since = t;
  };
  const Seen seen = follow({sticky}, 3, 1, {}, turn);
  EXPECT_EQ(seen.regular, (std::vector<double>{0, 1, 2, 3}));
  EXPECT_EQ(seen.chatter, 1) << seen.events.size() << " events, " << seen.attempts << " attempts";
  EXPECT_LT(seen.attempts, 1000);
}

}  // namespace
}  // namespace engrane::test
