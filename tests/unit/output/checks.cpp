// SPDX-License-Identifier: BSD-3-Clause
#include "output/checks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace engrane::testing {

using namespace output;

namespace {

deck::CheckCard card(const std::string& measure, double expected) {
  deck::CheckCard c;
  c.element = 7;
  c.quantity = "FORCE";
  c.measure = {measure, {}};
  c.value = expected;
  return c;
}

/// The result of one check on samples of f every `h` from 0 to `end`.
CheckResult run(const deck::CheckCard& c, const std::function<double(double)>& f, double h, double end) {
  Checks checks({{c, 1}});
  double t = 0;  // summed up as a run does
  for (int i = 0; i <= std::lround(end / h); ++i, t += h) checks.observe(t, std::vector{-1.0, f(t)});
  return checks.results().at(0);
}

double cubic(double t) { return 1 + t * (2 - t * (3 - t)); }

TEST(Checks, ValueAtTheEndAndAtATime) {
  EXPECT_TRUE(run(card("VALUE", cubic(2)), cubic, 0.1, 2).passed);
  deck::CheckCard at = card("VALUE", cubic(0.5));
  at.time = 0.5;
  EXPECT_TRUE(run(at, cubic, 0.1, 2).passed);  // at a step, but for rounding
  EXPECT_EQ(run(at, cubic, 0.1, 2).text, "ELEMENT 7 FORCE at t = 0.5");
  at.time = 0.77;
  EXPECT_NEAR(run(at, cubic, 0.1, 2).value, cubic(0.77), 1e-15);  // a cubic through four samples
  at.time = 0.03;
  EXPECT_NEAR(run(at, cubic, 0.1, 2).value, cubic(0.03), 1e-15);  // one before, three after
  at.time = 1.93;
  EXPECT_NEAR(run(at, cubic, 0.1, 2).value, cubic(1.93), 1e-14);
  at.time = 0;
  EXPECT_EQ(run(at, cubic, 0.1, 2).value, 1);
  at.time = 2;
  EXPECT_NEAR(run(at, cubic, 0.1, 2).value, cubic(2), 1e-14);
}

TEST(Checks, InterpolationIsOfFourthOrder) {
  deck::CheckCard at = card("VALUE", 0);
  at.time = 0.55;
  const auto error = [&](double h) {
    return std::abs(run(
                        at, [](double t) { return std::sin(3 * t); }, h, 1)
                        .value -
                    std::sin(1.65));
  };
  EXPECT_GT(error(0.1) / error(0.1 / 3), 60);  // 3⁴ = 81
}

TEST(Checks, WhatWasNeverReachedFails) {
  deck::CheckCard at = card("VALUE", 0);
  at.time = 3;
  at.absolute = 1e9;
  const CheckResult late = run(at, cubic, 0.1, 2);
  EXPECT_FALSE(late.passed);
  EXPECT_NE(late.remark.find("ended at t = "), std::string::npos);
  at.time = -1;
  EXPECT_NE(run(at, cubic, 0.1, 2).remark.find("started at t = 0"), std::string::npos);
  deck::CheckCard window = card("MAX", 0);
  window.absolute = 1e9;
  window.window = {1, 3};
  EXPECT_FALSE(run(window, cubic, 0.1, 2).passed);
  EXPECT_FALSE(Checks({{window, 0}}).results()[0].passed);
}

TEST(Checks, MeasuresOverAWindow) {
  const auto sine = [](double t) { return 3 + 2 * std::sin(2 * std::numbers::pi * t); };
  const auto value = [&](const std::string& measure, std::vector<double> window) {
    deck::CheckCard c = card(measure, 0);
    c.window = std::move(window);
    return run(c, sine, 1e-3, 3).value;
  };
  EXPECT_NEAR(value("MAX", {}), 5, 1e-9);
  EXPECT_NEAR(value("MIN", {}), 1, 1e-9);
  EXPECT_NEAR(value("AMPLITUDE", {1, 2}), 2, 1e-9);
  EXPECT_NEAR(value("MEAN", {0.25, 1.25}), 3, 1e-9);
  EXPECT_NEAR(value("RMS", {0.25, 1.25}), std::sqrt(9 + 2), 1e-5);
  EXPECT_NEAR(value("MAX", {0.5003, 0.9}), sine(0.5003), 1e-5);  // cut between samples
  EXPECT_NEAR(value("MEAN", {0, 0.5}), 3 + 4 / std::numbers::pi, 1e-5);
  EXPECT_NEAR(value("MEAN", {0.50021, 0.50022}), sine(0.500215), 1e-6);
}

TEST(Checks, MeanWeighsByTime) {
  Checks checks({{card("MEAN", 2.4), 0}, {card("RMS", std::sqrt(2 * 16.0 / 3 / 5 + 3 * 7.0 / 5)), 0}});
  // steps of unequal length: 0 to 4 in 2 s, then 4 … 1 in 3 s
  checks.observe(0, std::vector{0.0});
  checks.observe(2, std::vector{4.0}, true, true);  // a corner
  checks.observe(5, std::vector{1.0});
  EXPECT_NEAR(checks.results()[0].value, (2 * 2 + 3 * 2.5) / 5, 1e-15);
  EXPECT_TRUE(checks.results()[1].passed) << checks.results()[1].value;
}

TEST(Checks, Tolerances) {
  const auto passes = [](std::optional<double> relative, std::optional<double> absolute, double value) {
    deck::CheckCard c = card("VALUE", 100);
    c.relative = relative;
    c.absolute = absolute;
    return run(
               c, [value](double) { return value; }, 1, 0)
        .passed;
  };
  EXPECT_TRUE(passes({}, {}, 100.00009));
  EXPECT_FALSE(passes({}, {}, 100.00011));
  EXPECT_TRUE(passes(0.01, {}, 99.1));
  EXPECT_FALSE(passes({}, 0.5, 99.1));
  EXPECT_TRUE(passes(0.01, 0.5, 99.1));  // one suffices
  EXPECT_FALSE(passes(0.01, 0.5, std::nan("")));
}

TEST(Checks, SingleInstantAndRepeatedTimes) {
  EXPECT_EQ(run(
                card("MEAN", 5), [](double) { return 5.0; }, 1, 0)
                .value,
            5);
  EXPECT_EQ(run(
                card("RMS", 5), [](double) { return -5.0; }, 1, 0)
                .value,
            5);
  EXPECT_EQ(run(
                card("AMPLITUDE", 0), [](double) { return -5.0; }, 1, 0)
                .value,
            0);
  deck::CheckCard at = card("VALUE", 0);
  at.time = 1.5;
  Checks checks({{at, 0}});
  for (const auto& [t, y] : {std::pair{0.0, 0.0}, {1.0, 9.0}, {1.0, 1.0}, {2.0, 9.0}, {2.0, 2.0}, {3.0, 3.0}})
    checks.observe(t, std::vector{y});
  EXPECT_NEAR(checks.results()[0].value, 1.5, 1e-15);
}

}  // namespace
}  // namespace engrane::testing
