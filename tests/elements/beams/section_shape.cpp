// SPDX-License-Identifier: BSD-3-Clause
#include "elements/beams/section_shape.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace engrane::elements::beams {
namespace {

using Vec2 = SectionShape::Vec2;
using Mat2 = SectionShape::Mat2;

SectionShape made(const std::string& name, std::vector<double> sizes, double poisson = 0.3) {
  deck::ProfileCard card;
  card.shape = {name, std::move(sizes)};
  return shape_of(card, poisson);
}

void expect_near(const Mat2& a, const Mat2& b, double tolerance) {
  EXPECT_LE((a - b).norm(), tolerance * b.norm()) << a << "\n" << b;
}

/// Torsion is a series, the shear factor is Cowper's whatever the ratio of the sides.
TEST(SectionShape, RectangleAsPolygon) {
  for (const double ratio : {1.0, 2.0, 10.0})
    for (const double poisson : {0.0, 0.3}) {
      const SectionShape closed = made("RECTANGLE", {ratio, 1}, poisson);
      const SectionShape solved = made("POLYGON", {3, 2, 3, 3, 3 - ratio, 3, 3 - ratio, 2}, poisson);
      EXPECT_NEAR(solved.area, closed.area, 1e-14 * closed.area);
      expect_near(solved.moments, closed.moments, 1e-13);
      EXPECT_NEAR(solved.torsion, closed.torsion, 1e-6 * closed.torsion);
      expect_near(solved.shear_factors, closed.shear_factors, 2e-5);
      EXPECT_LE(solved.shear_center.norm(), 1e-9 * ratio);
    }
  EXPECT_NEAR(made("RECTANGLE", {2, 1}).torsion, 0.457363, 1e-6);
}

/// Polygons of 24 and 48 sides come to the circle and to the tube, with the square of the sides.
TEST(SectionShape, TubeAsPolygon) {
  const auto polygon = [](int sides, double inner) {
    deck::ProfileCard card;
    card.shape.tag = "POLYGON";
    for (int k = 0; k < sides; ++k) {
      const double a = 2 * std::numbers::pi * k / sides;
      card.shape.values.insert(card.shape.values.end(), {std::cos(a) / 2, std::sin(a) / 2});
      if (inner > 0) card.hole.insert(card.hole.end(), {inner * std::cos(a) / 2, inner * std::sin(a) / 2});
    }
    return shape_of(card, 0.3);
  };
  for (const double inner : {0.0, 0.6}) {
    const SectionShape closed = made("TUBE", {1, inner});
    std::vector<double> torsion, shear;
    for (const int sides : {24, 48}) {
      const SectionShape solved = polygon(sides, inner);
      torsion.push_back(solved.torsion / closed.torsion - 1);
      shear.push_back(solved.shear_factors(0, 0) / closed.shear_factors(0, 0) - 1);
      EXPECT_NEAR(solved.shear_factors(1, 1), solved.shear_factors(0, 0), 1e-6);
    }
    EXPECT_NEAR(torsion[0] / torsion[1], 4, 0.15);
    EXPECT_LE(std::abs(torsion[1]), 0.009);
    EXPECT_LE(std::abs(shear[1]), inner > 0 ? 3e-3 : 1e-4);
  }
}

/// A square turned by 30 degrees, and an angle by 45: torsion stays, tensors turn.
TEST(SectionShape, TurnedPolygon) {
  const Loop angle = {{0, 0}, {3, 0}, {3, 0.4}, {0.5, 0.4}, {0.5, 2}, {0, 2}};
  const double c = std::cos(0.7), s = std::sin(0.7);
  Mat2 turn;
  turn << c, -s, s, c;
  Loop turned;
  for (const Vec2& corner : angle) turned.push_back(turn * corner + Vec2(4, -7));
  const SectionShape one = polygon_shape({angle}, 0.3), other = polygon_shape({turned}, 0.3);
  EXPECT_NEAR(other.torsion, one.torsion, 1e-9 * one.torsion);
  expect_near(other.moments, turn * one.moments * turn.transpose(), 1e-12);
  expect_near(other.shear_factors, turn * one.shear_factors * turn.transpose(), 1e-9);
  EXPECT_LE((other.shear_center - turn * one.shear_center).norm(), 1e-9);
}

/// Thin walls (Timoshenko and Goodier 1970, art. 115 to 117; shear centre of a channel from the middle of its web: 3 b²/(6 b +
/// h)).
TEST(SectionShape, ThinWalls) {
  const double t = 0.01;
  const SectionShape channel = made("U", {1 + t, 0.5 + t / 2, t, t});
  EXPECT_NEAR(channel.torsion, 2 * t * t * t / 3, 0.01 * channel.torsion);
  const Vec2 web(0, channel.outline.front()[1] + t / 2);  // from the centroid
  EXPECT_NEAR(web[1] - channel.shear_center[1], 3 * 0.25 / (6 * 0.5 + 1), 0.002);
  EXPECT_NEAR(channel.shear_center[0], 0, 1e-6);

  const SectionShape box = made("BOX", {1 + t, 0.5 + t, t});
  EXPECT_NEAR(box.torsion, 4 * 0.25 * t / 3, 0.03 * box.torsion);  // Bredt: 4 A²/∮ds/t

  const SectionShape angle = made("L", {1 + t / 2, 0.6 + t / 2, t});
  const Vec2 meeting = angle.outline.front() + Vec2(t / 2, t / 2);
  EXPECT_LE((angle.shear_center - meeting).norm(), t / 5);

  // the web carries the shear of an I-section
  const SectionShape girder = made("H", {0.6, 0.2, 0.006, 0.01});
  EXPECT_NEAR(girder.shear_factors(0, 0) * girder.area, 0.6 * 0.006, 0.05 * 0.6 * 0.006);
  EXPECT_LE(girder.shear_center.norm(), 1e-7);
}

/// The same numbers whatever the unit of length.
TEST(SectionShape, Units) {
  const SectionShape metre = made("H", {0.2, 0.1, 0.0056, 0.0085}), micron = made("H", {2e5, 1e5, 5600, 8500});
  EXPECT_NEAR(micron.torsion, metre.torsion * 1e24, 1e-9 * micron.torsion);
  expect_near(micron.shear_factors, metre.shear_factors, 1e-9);
}

}  // namespace
}  // namespace engrane::elements::beams
