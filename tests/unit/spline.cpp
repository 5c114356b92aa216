// SPDX-License-Identifier: BSD-3-Clause
#include "math/spline.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace engrane {
namespace {

/// Gauss rule of three points on each of `n` parts: exact for cubics between knots at part ends.
double quadrature(const Curve& curve, double a, double b, int n) {
  double sum = 0;
  const double h = (b - a) / n;
  for (int i = 0; i < n; ++i) {
    const double m = a + (i + 0.5) * h, d = h / 2 * std::sqrt(0.6);
    sum += h / 18 * (5 * curve.at(m - d).f + 8 * curve.at(m).f + 5 * curve.at(m + d).f);
  }
  return sum;
}

TEST(Curve, LinesHoldTheirEnds) {
  const Curve drive = Curve::lines(std::vector{0.0, 1.0}, std::vector{0.0, 1.0});
  EXPECT_EQ(drive.at(0.25).f, 0.25);
  EXPECT_EQ(drive.at(0).d1, 1);
  EXPECT_EQ(drive.at(1).d1, 0);  // the right side of the corner
  EXPECT_EQ(drive.at(2).f, 1);
  EXPECT_EQ(drive.at(-1).f, 0);
  EXPECT_EQ(drive.at(-1).d1, 0);
  EXPECT_EQ(drive.integral(1), 0.5);
  EXPECT_EQ(drive.integral(3), 2.5);
  const Curve late = Curve::lines(std::vector{1.0, 2.0}, std::vector{3.0, 5.0});
  EXPECT_EQ(late.integral(1), 3);
  EXPECT_EQ(late.integral(-2), -6);
  EXPECT_EQ(late.integral(2), 7);
  EXPECT_EQ(Curve::lines(std::vector{4.0}, std::vector{2.0}).integral(10), 20);
}

TEST(Curve, ATableThatGoesFarOutKeepsTheDigitsOfSmallAbscissas) {
  const double far = 1e9, x = 1.1e-3;
  const Curve two = Curve::lines(std::vector{-far, far}, std::vector{-2 * far, 2 * far});
  const Curve three = Curve::lines(std::vector{-far, 0.0, far}, std::vector{-2 * far, 0.0, 2 * far});
  for (const Curve& line : {two, three})
    for (const double at : {x, -x}) {
      EXPECT_DOUBLE_EQ(line.at(at).f, 2 * at);
      EXPECT_DOUBLE_EQ(line.integral(at), at * at);
      EXPECT_EQ(line.at(at).d1, 2);
    }
  EXPECT_TRUE(two.corners(-1, 1, 10).empty());
  const Curve spline = Curve::natural_spline(std::vector{-far, 0.0, far}, std::vector{-2 * far, 0.0, 2 * far});
  for (const double at : {x, -x}) EXPECT_NEAR(spline.integral(at), at * at, 1e-12 * x * x);
}

TEST(Curve, AreasOnBothSidesOfZero) {
  const std::vector<double> x{-3, -1.5, -0.4, 0.7, 2}, y{2, -1, 0.5, 3, -2};
  for (const double beside : {-7.0, 0.0, 7.0}) {  // points before, about and behind 0
    std::vector<double> at = x;
    for (double& one : at) one += beside;
    for (const Curve& curve : {Curve::lines(at, y), Curve::natural_spline(at, y)})
      for (const double from : {-4.0, -2.2, -1.0, 1.1, 3.5})
        EXPECT_NEAR(curve.integral(from + beside) - curve.integral(at[0]), quadrature(curve, at[0], from + beside, 40000), 3e-8);
  }
  std::vector<double> closed = y;
  closed.back() = closed.front();
  const Curve turning = Curve::periodic_spline(x, closed, 5);
  EXPECT_NEAR(turning.integral(6.3), quadrature(turning, 0, 6.3, 40000), 1e-8);
  EXPECT_NEAR(turning.integral(-8.1), quadrature(turning, 0, -8.1, 40000), 1e-8);
}

TEST(Curve, PeriodicLines) {
  const Curve triangle = Curve::lines(std::vector{0.0, 1.0}, std::vector{0.0, 1.0}, 2.0);  // a line closes the gap
  EXPECT_EQ(triangle.at(1.5).f, 0.5);
  EXPECT_EQ(triangle.at(-0.5).f, 0.5);
  EXPECT_EQ(triangle.at(-0.5).d1, -1);
  EXPECT_EQ(triangle.integral(7), 3.5);
  EXPECT_EQ(triangle.integral(-3), -1.5);
  EXPECT_EQ(triangle.at(2e9 + 0.25).f, 0.25);
  const Curve saw = Curve::lines(std::vector{0.0, 1.0}, std::vector{0.0, 1.0}, 1.0);
  EXPECT_EQ(saw.at(1).f, 0);
  EXPECT_EQ(saw.at(1.75).f, 0.75);
  const Curve flat = Curve::lines(std::vector{0.5}, std::vector{3.0}, 1.0);
  EXPECT_EQ(flat.at(100).f, 3);
  EXPECT_EQ(flat.integral(2), 6);
}

TEST(Curve, CornersOfLaterPeriodsAreMet) {
  // 0.2 + 0.8 is 1, but 1 - 0.8 is less than 0.2: the corner was found before itself
  const Curve drive = Curve::lines(std::vector{0.0, 0.2, 0.4}, std::vector{0.0, 0.5, 0.0}, 0.8);
  const Curve saw = Curve::lines(std::vector{0.1, 0.8}, std::vector{-2.0, 5.0}, 0.7);
  for (const double from : {-1e6, -700.0, 0.0, 700.0, 1e6}) {
    const std::vector<double> corners = drive.joints(from, from + 80, 1000), jumps = saw.joints(from, from + 70, 1000);
    EXPECT_NEAR(static_cast<double>(corners.size()), 300, 3);
    EXPECT_NEAR(static_cast<double>(jumps.size()), 100, 1);
    for (const double x : corners) {
      const double before = drive.at(std::nextafter(x, -2e6)).d1, after = drive.at(x).d1;
      EXPECT_EQ(after, before == 0 ? 2.5 : before == 2.5 ? -2.5 : 0) << x;
      EXPECT_NEAR(drive.integral(std::nextafter(x, -2e6)), drive.integral(x), 1e-9);
    }
    for (const double x : jumps) {
      EXPECT_NEAR(saw.at(x).f, -2, 1e-8) << x;
      EXPECT_NEAR(saw.at(std::nextafter(x, -2e6)).f, 5, 1e-8) << x;
    }
  }
}

TEST(Curve, NaturalSplineIsSmoothAndExactOnLines) {
  const std::vector<double> x{-1, 0, 0.5, 2, 3}, y{1, -2, 0.5, 4, 3};
  const Curve spline = Curve::natural_spline(x, y);
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(spline.at(x[i]).f, y[i], 1e-14);
  for (std::size_t i = 1; i + 1 < x.size(); ++i) {
    const Jet left = spline.at(std::nextafter(x[i], -10)), right = spline.at(x[i]);
    EXPECT_NEAR(left.f, right.f, 1e-13);
    EXPECT_NEAR(left.d1, right.d1, 1e-12);
    EXPECT_NEAR(left.d2, right.d2, 1e-11);
  }
  EXPECT_NEAR(spline.at(-1).d2, 0, 1e-13);
  EXPECT_NEAR(spline.at(std::nextafter(3.0, 0)).d2, 0, 1e-13);
  EXPECT_EQ(spline.at(5).f, 3);
  EXPECT_EQ(spline.at(3).d1, 0);
  EXPECT_DOUBLE_EQ(spline.at(-3).f, 1);
  EXPECT_EQ(spline.at(-3).d1, 0);
  for (const double t : {-2.5, -0.5, 0.25, 1.0, 2.5, 4.0})
    EXPECT_NEAR(spline.integral(t), t < 0 ? -quadrature(spline, t, 0, 400) : quadrature(spline, 0, t, 400), 1e-12) << t;

  const Curve line = Curve::natural_spline(std::vector{0.0, 1.0, 4.0}, std::vector{1.0, 3.0, 9.0});
  EXPECT_NEAR(line.at(2.5).f, 6, 1e-14);
  EXPECT_EQ(line.at(10).f, 9);
  EXPECT_EQ(Curve::natural_spline(std::vector{1.0, 2.0}, std::vector{0.0, 1.0}).at(1.5).f, 0.5);
}

TEST(Curve, DerivativesBelongTogether) {
  const Curve spline = Curve::natural_spline(std::vector{0.0, 1.0, 2.0, 3.5}, std::vector{0.0, 2.0, -1.0, 0.5});
  const double t = 1.3, h = 0.1;
  const Jet a = spline.at(t), b = spline.at(t + h);  // one cubic: the series is exact
  EXPECT_NEAR(b.f, a.f + h * (a.d1 + h / 2 * (a.d2 + h / 3 * a.d3)), 1e-14);
  EXPECT_NEAR(b.d1, a.d1 + h * (a.d2 + h / 2 * a.d3), 1e-14);
}

TEST(Curve, PeriodicSpline) {
  const double turn = 2 * std::numbers::pi;
  std::vector<double> x, y;
  for (int i = 0; i < 64; ++i) {
    x.push_back(turn * i / 64 + 0.02 * std::sin(i));
    y.push_back(std::sin(x.back()));
  }
  const Curve open = Curve::periodic_spline(x, y, turn);
  std::vector<double> xc = x, yc = y;
  xc.push_back(x[0] + turn);
  yc.push_back(y[0]);
  const Curve closed = Curve::periodic_spline(xc, yc, turn);
  for (const double t : {-10.0, 0.0, 0.3, 3.0, 6.2831, 100.0}) {
    EXPECT_NEAR(open.at(t).f, std::sin(t), 2e-6) << t;
    EXPECT_NEAR(open.at(t).d1, std::cos(t), 2e-4) << t;
    EXPECT_NEAR(open.at(t).f, closed.at(t).f, 1e-13) << t;
    EXPECT_NEAR(open.integral(t), 1 - std::cos(t), 1e-5) << t;
  }
  const Jet before = open.at(std::nextafter(x[0], -1)), after = open.at(x[0]);
  EXPECT_NEAR(before.f, after.f, 1e-13);
  EXPECT_NEAR(before.d1, after.d1, 1e-12);
  EXPECT_NEAR(before.d2, after.d2, 1e-10);

  const Curve two = Curve::periodic_spline(std::vector{0.0, 0.5}, std::vector{1.0, -1.0}, 1.0);
  EXPECT_NEAR(two.at(0.25).f, 0, 1e-15);
  EXPECT_NEAR(two.at(0.0).d1, 0, 1e-15);
  EXPECT_NEAR(two.at(0.5).d2, two.at(std::nextafter(0.5, 0)).d2, 1e-11);
  const Curve three = Curve::periodic_spline(std::vector{0.0, 0.25, 0.5}, std::vector{1.0, 0.0, -1.0}, 1.0);
  const Jet l = three.at(std::nextafter(1.0, 0)), r = three.at(1.0);
  EXPECT_NEAR(l.d1, r.d1, 1e-12);
  EXPECT_NEAR(l.d2, r.d2, 1e-10);
}

TEST(Curve, JointsAreThePointsOfASpline) {
  const std::vector<double> x{0, 1, 3, 4}, y{0, 2, -1, 0}, line{0, 2, 6, 8};
  using Places = std::vector<double>;
  EXPECT_EQ(Curve::natural_spline(x, y).joints(-1, 5, 10), x);
  EXPECT_EQ(Curve::natural_spline(x, y).joints(0, 4, 10), (Places{1, 3}));
  EXPECT_EQ(Curve::natural_spline(x, y).corners(-1, 5, 10), (Places{0, 4}));  // constant outside
  EXPECT_TRUE(Curve::natural_spline(x, y).joints(-1, 5, 3).empty());
  EXPECT_EQ(Curve::natural_spline(x, line).joints(-1, 5, 10), (Places{0, 4}));
  EXPECT_EQ(Curve::lines(x, y).joints(-1, 5, 10), Curve::lines(x, y).corners(-1, 5, 10));
  EXPECT_EQ(Curve::periodic_spline(x, y, 4).joints(0.5, 5.5, 10), (Places{1, 3, 4, 5}));
  EXPECT_TRUE(Curve::periodic_spline(x, y, 4).corners(0.5, 5.5, 10).empty());
}

}  // namespace
}  // namespace engrane
