// SPDX-License-Identifier: BSD-3-Clause
#include "output/window.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace engrane::testing {

using output::Window;

namespace {

constexpr double turn = 2 * std::numbers::pi;

/// Of 3 + 2 sin over a turn and a quarter from an eighth of one, from so many samples in a turn.
Window::Measures sine(int samples) {
  Window window(0.125, 1.375);
  for (int i = 0; i <= 2 * samples; ++i) {
    const double t = static_cast<double>(i) / samples;
    window.add(t, 3 + 2 * std::sin(turn * t), false, 0);
  }
  return window.measures();
}

TEST(Window, ErrorsAreOfFourthOrder) {
  const double mean = 3 + 2 * (std::cos(turn / 8) - std::cos(11 * turn / 8)) / turn / 1.25;
  double before = 0;
  for (const int samples : {20, 40, 80}) {
    const Window::Measures found = sine(samples);
    const double off = std::abs(found.mean - mean);
    if (before > 0) {
      EXPECT_LT(off, before / 12);
    }
    before = off;
    EXPECT_NEAR(found.least, 1, 2 / std::pow(samples, 3));
    EXPECT_NEAR(found.largest, 5, 2 / std::pow(samples, 3));
  }
  EXPECT_LT(before, 1e-6);
}

TEST(Window, ExtremesBetweenSamples) {
  // a parabola with its top between two samples, and its mean square
  Window window;
  for (const double t : {0.0, 0.4, 0.7, 1.0}) window.add(t, t * (1 - t), false, 0);
  EXPECT_NEAR(window.measures().largest, 0.25, 1e-15);
  EXPECT_NEAR(window.measures().mean, 1.0 / 6, 1e-15);
  EXPECT_NEAR(window.measures().rms, std::sqrt(1.0 / 30), 1e-15);
}

TEST(Window, NoExtremeIsInventedAtACorner) {
  for (const bool known : {false, true}) {
    Window window;
    for (int i = 0; i <= 20; ++i) window.add(0.1 * i, i < 10 ? 1.0 : 1 + 3 * (0.1 * i - 1), known && i == 10, 0);
    EXPECT_DOUBLE_EQ(window.measures().least, 1);
    EXPECT_DOUBLE_EQ(window.measures().largest, 4);
    if (known) {
      EXPECT_NEAR(window.measures().mean, 1.75, 1e-14);
    }
  }
}

TEST(Window, JumpsAndUnevenIntervals) {
  // 1 until t = 1, where it jumps to a parabola; a sample a billionth behind another one
  Window window;
  for (const double t : {0.0, 0.5, 1.0}) window.add(t, 1, false, 0);
  for (const double t : {1.0, 1.2, 1.2 + 1e-9, 1.5, 2.0}) window.add(t, 5 + (t - 1) * (2 - t), false, 0);
  EXPECT_NEAR(window.measures().mean, (1 + 5 + 1.0 / 6) / 2, 1e-3);
  EXPECT_NEAR(window.measures().largest, 5.25, 1e-2);
  EXPECT_EQ(window.measures().least, 1);
}

TEST(Window, RestartsGoOn) {
  const auto value = [](int i) { return std::sin(0.7 * i) + 0.1 * i; };
  Window whole, first;
  for (int i = 0; i < 30; ++i) whole.add(0.3 * i, value(i), i == 17, 0);
  for (int i = 0; i < 19; ++i) first.add(0.3 * i, value(i), i == 17, 0);
  Window second;
  second.load(first.save());
  for (int i = 19; i < 30; ++i) second.add(0.3 * i, value(i), false, 0);
  EXPECT_EQ(whole.measures().rms, second.measures().rms);
  EXPECT_EQ(whole.measures().largest, second.measures().largest);
  EXPECT_TRUE(std::isnan(Window().measures().mean));
}

}  // namespace
}  // namespace engrane::testing
