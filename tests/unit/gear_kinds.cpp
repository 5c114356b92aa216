// SPDX-License-Identifier: BSD-3-Clause
// Short forms of GEAR against the formulas of handbooks, and the places of second wheels.
#include "elements/gears/gear_kinds.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "elements/gears/gear_report.hpp"
#include "elements/gears/hypoid_cones.hpp"
#include "gear_deck.hpp"
#include "math/angle.hpp"

namespace engrane {

using namespace elements::gears;

namespace {

using gear_deck::Deck;

/// One pair at a skew place, B placed.
Deck one(const std::string& card) { return {"I 1 X 3 -2 5\nI 2", "I 1 GEAR N 1 2 AXIS 0.3 -0.2 0.9 PLACE 1 1 0 " + card}; }

double trade(const GearDesign& d, std::size_t wheel) { return paper_helix(d.helix[wheel], d.cone[wheel]) / degree; }

TEST(GearKinds, EveryPlacedPairCloses) {
  for (const char* card :
       {"KIND SPUR Z 20 40 MN 2", "KIND SPUR Z 20 40 DISTANCE 90", "KIND HELICAL Z 20 40 MN 2 HELIX -15",
        "KIND HELICAL Z 20 40 MN 2 DISTANCE 65 HAND LEFT", "KIND INTERNAL Z 20 60 MT 2", "KIND INTERNAL Z 60 20 MN 2 HELIX 12",
        "KIND BEVEL Z 20 31 MT 2 SHAFT 70", "KIND BEVEL Z 20 31 DIAMETER 93 SHAFT 115", "KIND SPIRAL Z 14 39 MN 2 HELIX 35",
        "KIND CROSSED Z 18 30 MN 2 HELIX 45 SHAFT 70", "KIND CROSSED Z 18 30 DISTANCE 80 HELIX -40 -50",
        "KIND HYPOID Z 11 43 HELIX 50 OFFSET 35 DIAMETER 170", "KIND HYPOID Z 11 43 HELIX -50 OFFSET -20 MN 4",
        "KIND HYPOID Z 43 11 HELIX -31.5 50 DIAMETER 170", "KIND WORM STARTS 2 Z 30 MX 4 Q 10",
        "KIND WORM STARTS 1 Z 40 DISTANCE 100 MN 3.9 SHAFT 80 HAND LEFT", "Z 20 40 MN 2 SHAFT 60", "Z 20 40 MN 2 HELIX 20",
        "Z 11 43 MN 3 CONE 19 68 HELIX -50 31.5"}) {
    const Deck deck = one(card);
    const GearPair& pair = deck.pair(1);
    const Closure c = closure(pair.design(), deck.node(1), deck.node(2), pair.frames().mu.col(0));
    EXPECT_LT(c.misfit(), 1e-12) << card;
    const Vec3 toward = Vec3(1, 1, 0) - Vec3(1, 1, 0).dot(pair.frames().mu.col(0)) * pair.frames().mu.col(0);
    EXPECT_LT((pair.frames().mu.col(1) - toward.normalized()).norm(), 1e-12) << card;
  }
}

TEST(GearKinds, ParallelAxles) {
  EXPECT_NEAR(one("KIND SPUR Z 20 40 DISTANCE 90").pair(1).design().normal_module, 3, 1e-15);
  EXPECT_NEAR(one("KIND INTERNAL Z 20 60 DISTANCE 60").pair(1).design().normal_module, 3, 1e-15);
  const GearDesign right = one("KIND HELICAL Z 20 40 MN 2 DISTANCE 65").pair(1).design();
  EXPECT_NEAR(trade(right, 0), std::acos(60.0 / 65) / degree, 1e-12);
  EXPECT_NEAR(trade(right, 1), -trade(right, 0), 1e-12);
  EXPECT_NEAR(trade(one("KIND HELICAL Z 20 40 MN 2 MT 2.5 HAND LEFT").pair(1).design(), 0), -std::acos(0.8) / degree, 1e-12);
  const GearDesign ring = one("KIND INTERNAL Z 20 60 MN 2 DISTANCE 45").pair(1).design();
  EXPECT_NEAR(trade(ring, 0), std::acos(40.0 / 45) / degree, 1e-12);
  EXPECT_NEAR(trade(ring, 1), trade(ring, 0), 1e-12);  // equal hands in a ring
  EXPECT_NEAR(one("KIND HELICAL Z 20 40 MT 2 HELIX 30").pair(1).design().normal_module, 2 * std::cos(30 * degree), 1e-15);
  // the helix may come from where the nodes are
  const Deck nodes("I 1\nI 2 X 65", "I 1 GEAR N 1 2 AXIS 0 0 1 KIND HELICAL Z 20 40 MN 2");
  EXPECT_NEAR(trade(nodes.pair(1).design(), 0), std::acos(60.0 / 65) / degree, 1e-12);
}

TEST(GearKinds, BevelSideFollowsTheNodes) {
  for (const double side : {1.0, -1.0}) {
    const Deck deck("I 1 Z " + std::to_string(60 * side) + "\nI 2 X 30", "I 1 GEAR N 1 2 AXIS 0 0 1 KIND BEVEL Z 20 40 MN 3");
    EXPECT_NEAR(deck.pair(1).design().cone[0], side * std::atan(0.5), 1e-15);
  }
}

TEST(GearKinds, CrossedHelices) {
  const GearDesign d = one("KIND CROSSED Z 18 30 MN 2 HELIX 45 SHAFT 70").pair(1).design();
  EXPECT_NEAR(trade(d, 1), 25, 1e-12);
  EXPECT_NEAR(trade(one("KIND CROSSED Z 18 30 MN 2 HELIX -45 SHAFT 30").pair(1).design(), 1), 15, 1e-12);
  const GearDesign a = one("KIND CROSSED Z 18 30 DISTANCE 80 HELIX 40 50").pair(1).design();
  EXPECT_NEAR(a.radius(0) + a.radius(1), 80, 1e-12);
}

TEST(GearKinds, WormFromAnyTwoSizes) {
  // 2 threads, 30 teeth, transverse pitch 6 per inch, worm of 2 in (Shigley & Uicker): lead angle 9.46232221°
  const double lambda = std::atan(1.0 / 6), mx = 1.0 / 6, mn = mx * std::cos(lambda);
  EXPECT_NEAR(lambda / degree, 9.46232221, 5e-9);
  const std::vector<std::pair<std::string, double>> sizes{
      {"LAMBDA", lambda / degree},    {"Q", 12},       {"MN", mn},       {"MX", mx},
      {"LEAD", std::numbers::pi / 3}, {"DIAMETER", 2}, {"DISTANCE", 3.5}};
  int pairs = 0;
  for (std::size_t i = 0; i < sizes.size(); ++i)
    for (std::size_t j = i + 1; j < sizes.size(); ++j) {
      if (j == 1 || (sizes[i].first == "MX" && sizes[j].first == "LEAD")) continue;  // they say the same
      std::string card = "KIND WORM STARTS 2 Z 30";
      for (const auto k : {i, j}) card += " " + sizes[k].first + " (" + fmt::format("{:.17g}", sizes[k].second) + ")";
      const Deck deck = one(card);
      const GearDesign& d = deck.pair(1).design();
      EXPECT_NEAR(d.radius(0), 1, 1e-13) << card;
      EXPECT_NEAR(d.radius(1), 2.5, 1e-13) << card;
      EXPECT_NEAR(trade(d, 0), 90 - lambda / degree, 1e-11) << card;
      EXPECT_NEAR(trade(d, 1), lambda / degree, 1e-11) << card;
      ++pairs;
    }
  EXPECT_EQ(pairs, 19);
  const GearDesign left = one("KIND WORM STARTS 2 Z 30 MX 4 Q 10 HAND LEFT SHAFT 80").pair(1).design();
  EXPECT_NEAR(trade(left, 0) + trade(left, 1), -80, 1e-12);
  // one size and the places of the nodes
  const Deck nodes("I 1\nI 2 X 3.5", "I 1 GEAR N 1 2 AXIS 0 0 1 KIND WORM STARTS 2 Z 30 DIAMETER 2");
  EXPECT_NEAR(trade(nodes.pair(1).design(), 1), lambda / degree, 1e-10);
}

/// The point of the line x + t e that is nearest to the line y + s f, and the distance of the lines.
std::pair<Vec3, double> nearest_point(const Vec3& x, const Vec3& e, const Vec3& y, const Vec3& f) {
  const Vec3 n = e.cross(f);
  const double t = (y - x).cross(f).dot(n) / n.squaredNorm();
  return {x + t * e, std::abs((y - x).dot(n.normalized()))};
}

TEST(GearKinds, HypoidMeetsItsConditions) {
  for (const double shaft : {90.0, 75.0, 95.0})
    for (const double offset : {35.0, 10.0, -15.0})
      for (const char* hand : {"", "-"}) {
        const std::string card =
            fmt::format("KIND HYPOID Z 11 43 HELIX {}50 OFFSET {} DIAMETER 170 SHAFT {}", hand, offset, shaft);
        const Deck deck = one(card);
        const GearPair& pair = deck.pair(1);
        const GearDesign& d = pair.design();
        EXPECT_NEAR(d.radius(1), 85, 1e-12) << card;
        EXPECT_NEAR(d.radius(0), 11 * d.normal_module / (2 * std::cos(50 * degree)), 1e-12) << card;
        const Vec3 e_p = pair.frames().mu.col(0), e_g = pair.frames().xi.col(0);
        EXPECT_NEAR(std::acos(e_p.dot(e_g)) / degree, shaft, 1e-11) << card;
        // from the places of the nodes alone: offset, and the apex of the ring's pitch cone on its axle
        const auto [foot, distance] = nearest_point(deck.node(2), e_g, deck.node(1), e_p);
        EXPECT_NEAR(distance, std::abs(offset), 1e-11) << card;
        EXPECT_LT((deck.node(2) - 85 / std::tan(d.cone[1]) * e_g - foot).norm(), 1e-10) << card;
        // the cones touch: their normals at the contact point are one line
        const auto normal = [](const Mat3& triad, double cone) {
          return Vec3(std::cos(cone) * triad.col(1) - std::sin(cone) * triad.col(0));
        };
        EXPECT_LT((normal(pair.frames().mu, d.cone[0]) + normal(pair.frames().xi, d.cone[1])).norm(), 1e-13) << card;
        EXPECT_EQ(std::abs(trade(d, 0)) > std::abs(trade(d, 1)), offset > 0) << card;
        EXPECT_LT(trade(d, 0) * trade(d, 1), 0) << card;
      }
}

TEST(GearKinds, HypoidExample) {
  // z = 11/43, ψ_P = 50°, ψ_G = 31.5°, R_G = 85: R_P = 28.84306742
  const GearDesign d = one("KIND HYPOID Z 11 43 HELIX -50 31.5 DIAMETER 170").pair(1).design();
  EXPECT_NEAR(d.radius(0), 28.84306742, 5e-9);
  EXPECT_NEAR(d.radius(1), 85, 1e-12);
  EXPECT_NEAR(std::cos(d.helix[0]) / std::cos(d.helix[1]), 0.75387911, 5e-9);
  // with the offset that belongs to it the ring's spiral comes out; and with its cone too
  HypoidDesign h;
  h.pinion_teeth = 11;
  h.ring_teeth = 43;
  h.shaft_angle = 90 * degree;
  h.pinion_spiral = 50 * degree;
  h.ring_radius = 85;
  h.ring_spiral = 31.5 * degree;
  const auto first = hypoid_cones(h);
  ASSERT_TRUE(first);
  h.offset = first->offset;
  const auto third = hypoid_cones(h);  // offset and both spirals: the apex is not asked for, and yet where it was
  ASSERT_TRUE(third);
  EXPECT_NEAR(third->ring_cone, first->ring_cone, 1e-10);
  h.ring_spiral = {};
  const auto second = hypoid_cones(h);
  ASSERT_TRUE(second);
  EXPECT_NEAR(second->ring_spiral / degree, 31.5, 1e-11);
  EXPECT_NEAR(second->ring_cone, first->ring_cone, 1e-13);
  // at right angles tanγ_P = cos(ψ_P − ψ_G)/tanγ_G
  h.ring_cone = 70 * degree;
  h.offset = {};
  h.ring_spiral = 31.5 * degree;
  EXPECT_NEAR(hypoid_cones(h)->pinion_cone, std::atan(std::cos(18.5 * degree) / std::tan(70 * degree)), 1e-13);
}

TEST(GearKinds, HypoidWithoutOffsetIsTheSpiralBevelPair) {
  for (const double shaft : {90.0, 60.0, 105.0}) {
    const std::string tail = fmt::format(" Z 14 39 HELIX 35 DIAMETER 117 SHAFT {}", shaft);
    const GearDesign h = one("KIND HYPOID OFFSET 0" + tail).pair(1).design(), s = one("KIND SPIRAL" + tail).pair(1).design();
    EXPECT_NEAR(h.normal_module, s.normal_module, 1e-13);
    for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) {
      EXPECT_NEAR(h.cone[i], s.cone[i], 1e-13);
      EXPECT_NEAR(h.helix[i], s.helix[i], 1e-13);
    }
  }
}

TEST(GearReport, LeastTeethAndHuntingPeriod) {
  GearDesign d = one("KIND SPUR Z 18 40 MN 2").pair(1).design();
  EXPECT_NEAR(least_teeth(d, 0), 17.0973, 1e-4);  // 2/sin² 20°, the handbook's 17
  EXPECT_EQ(hunting_period({18, 40}), 20);
  EXPECT_EQ(hunting_period({17, 40}), 40);
  EXPECT_EQ(hunting_period({20, 40}), 2);
  EXPECT_FALSE(one("KIND SPUR Z 18 40 MN 2").warned("undercut"));
  EXPECT_TRUE(one("KIND SPUR Z 17 40 MN 2").warned("undercut"));
  EXPECT_FALSE(one("KIND HELICAL Z 14 40 MN 2 HELIX 30").warned("undercut"));  // 12 at 30 degrees
  EXPECT_TRUE(one("KIND BEVEL Z 15 40 MN 2").warned("undercut"));              // 16.02 virtual teeth
  EXPECT_FALSE(one("KIND BEVEL Z 16 40 MN 2").warned("undercut"));             // 17.23
  EXPECT_TRUE(one("KIND SPUR Z 8 8 MN 2").warned("contact ratio"));
  EXPECT_FALSE(one("KIND SPUR Z 20 20 MN 2").warned("contact ratio"));
}

/// Does a corner of the pinion's tips enter the ring's teeth? Module 1; the pinion turns, the ring with it.
bool tips_strike(int z_1, int z_2, double alpha) {
  const auto inv = [](double a) { return std::tan(a) - a; };
  const double r_1 = z_1 / 2.0, r_2 = z_2 / 2.0, tip_1 = r_1 + 1, tip_2 = r_2 - 1;
  const double half_tooth = std::numbers::pi / 2 / z_1 + inv(alpha) - inv(std::acos(r_1 * std::cos(alpha) / tip_1));
  for (int i = 0; i < 200000; ++i) {
    const double phi = std::numbers::pi * i / 200000.0;
    const Vec3 corner(r_2 - r_1 + tip_1 * std::cos(phi + half_tooth), tip_1 * std::sin(phi + half_tooth), 0);
    const double radius = corner.norm();
    if (radius <= tip_2) return false;  // it has left the ring's teeth
    const double angle = std::atan2(corner[1], corner[0]) - phi * z_1 / z_2;
    const double half_space = std::numbers::pi / 2 / z_2 + inv(alpha) - inv(std::acos(r_2 * std::cos(alpha) / radius));
    if (std::abs(angle) > half_space + 1e-9) return true;
  }
  return false;
}

// Warnings about the teeth of equal pairs, such as those of planets, are given once; any datum that may change them counts.
TEST(GearReport, EqualPairsAreSpokenOfOnce) {
  const auto warnings = [](const std::string& one, const std::string& other) {
    const std::string head = " GEAR AXIS 0 0 1 MN 2 PLACE 1 0 0 ";
    Deck deck(" I 1\n I 2\n I 3\n", " I 1" + head + "N 1 2 " + one + "\n I 2" + head + "N 1 3 " + other);
    int count = 0;
    for (const Diagnostic& d : deck.diagnostics.all()) count += d.message.find("wheel A") == 0 ? 1 : 0;
    return count;
  };
  const std::string pair = "Z 12 40 ";
  EXPECT_EQ(warnings(pair, pair), 1);
  EXPECT_EQ(warnings("KIND HELICAL HELIX 10 " + pair, "KIND HELICAL HELIX 10 " + pair), 1);
  EXPECT_EQ(warnings(pair + "X 0.1 0", pair + "X 0.1 0"), 1);
  for (const char* different :
       {"Z 13 40", "Z 12 41", "Z 12 40 ALPHA 19", "Z 12 40 HELIX 10", "Z 12 40 CONE 30 60", "Z 12 40 SHAFT 90",
        "Z 12 40 INTERNAL", "Z 12 40 KIND SPUR", "Z 12 40 X 0.1 0", "Z 12 40 X 0.1 0 ADDENDUM 0.9"})
    EXPECT_EQ(warnings(pair, different), 2) << different;
  EXPECT_EQ(warnings(pair + "X 0.1 0", pair + "X 0.1 0 DEDENDUM 1.3"), 2);
}

TEST(GearReport, TipsOfInternalPairs) {
  for (const double alpha : {20.0, 25.0})
    for (const int ring : {45, 60, 90, 150})
      for (int difference = 3; difference < 14; ++difference) {
        GearDesign d;
        d.teeth = {ring - difference, ring};
        d.cone = {0, std::numbers::pi};
        d.pressure_angle = alpha * degree;
        EXPECT_EQ(internal_clearance(d)->tips < 0, tips_strike(ring - difference, ring, d.pressure_angle))
            << ring << " - " << difference << " at " << alpha;
      }
}

TEST(GearReport, InvoluteInterferenceOfInternalPairs) {
  // The path of contact ends where the line of action touches the pinion's base circle, r₁ sinα from the pitch point. With
  // addendum m that asks for z₁ ≥ z₂ − √(z₂² − 4 (z₂ − 1)/sin²α): 20.2 teeth in 60 at 20 degrees.
  const double s = std::sin(20 * degree) * std::sin(20 * degree);
  for (const int ring : {50, 60, 80, 120}) {
    const double least = ring - std::sqrt(ring * ring - 4 * (ring - 1) / s);
    for (const int pinion : {static_cast<int>(std::floor(least)), static_cast<int>(std::ceil(least))}) {
      GearDesign d;
      d.teeth = {pinion, ring};
      d.cone = {0, std::numbers::pi};
      d.pressure_angle = 20 * degree;
      EXPECT_EQ(internal_clearance(d)->involute < 0, pinion < least) << pinion << " in " << ring;
    }
  }
}

}  // namespace
}  // namespace engrane
