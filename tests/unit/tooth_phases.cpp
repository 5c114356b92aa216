// SPDX-License-Identifier: BSD-3-Clause
// Teeth round a train against the mesh phases of planetary gears: Parker & Lin, "Mesh phasing relationships in planetary and
// epicyclic gears" (2004): sun meshes of a planet at the angle φ_i have the relative phase z_s φ_i, ring meshes z_r φ_i.
#include "elements/gears/tooth_phases.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "gear_deck.hpp"
#include "math/angle.hpp"

namespace engrane {

using namespace elements::gears;

namespace {

using gear_deck::Deck;

/// Difference of two phases, a turn being nothing.
double difference(double a, double b) { return std::abs(std::remainder(a - b, 2 * std::numbers::pi)); }

struct Numbers {
  int sun = 24, planet = 24, ring = 72;
};

/// Sun at node 0, planets at 1, 2, …; pairs 1, 2, … with the sun and 11, 12, … with the ring at node 0.
Deck planetary(const std::vector<double>& angles, const Numbers& z, const std::string& teeth = "", bool planet_first = true) {
  std::string places, elements;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const double r = z.sun + z.planet, a = angles[i] * degree;  // module 2
    places += fmt::format("I {} X ({:.17g}) ({:.17g}) 0\n", i + 1, r * std::cos(a), r * std::sin(a));
    elements += fmt::format("I {} GEAR N 0 {} KIND SPUR Z {} {} MN 2 AXIS 0 0 1 {}\n", i + 1, i + 1, z.sun, z.planet, teeth);
    elements +=
        planet_first
            ? fmt::format("I {} GEAR N {} 0 KIND INTERNAL Z {} {} MN 2 AXIS 0 0 1 {}\n", i + 11, i + 1, z.planet, z.ring, teeth)
            : fmt::format("I {} GEAR N 0 {} KIND INTERNAL Z {} {} MN 2 AXIS 0 0 -1 {}\n", i + 11, i + 1, z.ring, z.planet, teeth);
  }
  return {places, elements};
}

const MeshPhase& mesh(const Deck& deck, int id) { return deck.pair(id).teeth().mesh; }

TEST(ToothPhases, PlanetsAsParkerAndLin) {
  // unequal angles that fit: multiples of 360/96 = 3.75 degrees
  const std::vector<double> angles{0, 116.25, 243.75};
  const Numbers z;
  for (const bool planet_first : {true, false}) {
    const Deck deck = planetary(angles, z, "", planet_first);
    EXPECT_EQ(mesh(deck, 1).phase, 0);
    for (std::size_t i = 0; i < angles.size(); ++i) {
      const int id = static_cast<int>(i) + 1;
      const double phi = angles[i] * degree;
      EXPECT_NEAR(difference(mesh(deck, id).phase - mesh(deck, 1).phase, -z.sun * phi), 0, 1e-10);
      // counted on the ring, about +z; a planet's phase and its ring's add up to half a pitch, about opposite axles
      const double ring = planet_first ? std::numbers::pi - mesh(deck, id + 10).phase : mesh(deck, id + 10).phase;
      const double ring_1 = planet_first ? std::numbers::pi - mesh(deck, 11).phase : mesh(deck, 11).phase;
      EXPECT_NEAR(difference(ring - ring_1, z.ring * phi), 0, 1e-10);
      EXPECT_EQ(mesh(deck, id + 10).misfit, 0);
      EXPECT_NEAR(difference(mesh(deck, id).contact[0], phi), 0, 1e-12);  // on the sun, from its first contact
      EXPECT_EQ(mesh(deck, id).contact[1], 0);
    }
  }
}

TEST(ToothPhases, BothMeshesOfAPlanet) {
  // The planet's contact points with sun and ring are opposite each other. With an even number of planet teeth a tooth stands
  // at one when one stands at the other. The sun's tooth is at the contact point, so the planet's space is there.
  for (const int planet : {24, 25}) {
    const Deck deck = planetary({0}, {24, planet, 24 + 2 * planet});
    const double expected = planet % 2 == 0 ? std::numbers::pi : 0;
    EXPECT_NEAR(difference(mesh(deck, 11).phase, expected), 0, 1e-10);
    EXPECT_NEAR(std::abs(mesh(deck, 11).contact[0]), std::numbers::pi, 1e-12);
  }
}

TEST(ToothPhases, MisfitOfMisplacedPlanets) {
  // A planet that stands δ too far round misses by (z_s + z_r) δ of a pitch of 2π: half a module for each unit of it
  const Numbers z;
  for (const double off : {0.02, -0.05}) {
    const Deck deck = planetary({0, 120 + off, 240}, z, "KM 1e5");
    EXPECT_FALSE(deck.diagnostics.has_errors());
    EXPECT_TRUE(deck.warned("miss each other"));
    EXPECT_NEAR(std::abs(mesh(deck, 12).misfit), (z.sun + z.ring) * std::abs(off) * degree * 2 / 2, 1e-10);
    EXPECT_EQ(mesh(deck, 11).misfit, 0);
    EXPECT_EQ(mesh(deck, 13).misfit, 0);
    EXPECT_EQ(mesh(deck, 12).misfit < 0, mesh(planetary({0, 120 + 2 * off, 240}, z, "KM 1e5"), 12).misfit < 0);
  }
  EXPECT_TRUE(planetary({0, 121, 240}, z, "KM 1e5").diagnostics.has_errors());  // 0.27 of a pitch
  EXPECT_TRUE(planetary({0, 120.02, 240}, z).diagnostics.has_errors());         // rigid teeth
  EXPECT_FALSE(planetary({0, 120, 240}, z).diagnostics.has_errors());
  // 25 planet teeth: (24 + 74) = 98 is no multiple of 3; 49 steps of 360/98 are half a turn
  EXPECT_TRUE(planetary({0, 120, 240}, {24, 25, 74}).diagnostics.has_errors());
  EXPECT_FALSE(planetary({0, 180}, {24, 25, 74}).diagnostics.has_errors());
}

TEST(ToothPhases, BevelDifferential) {
  // Two side gears of 18 teeth and pinions of 12: (18 + 18)·angle/360 must be an integer
  const auto differential = [](double angle) {
    const double a = angle * degree;
    return Deck(fmt::format("I 1 Z 24\nI 2 Z -24\nI 3 X 36\nI 4 X ({:.17g}) ({:.17g}) 0", 36 * std::cos(a), 36 * std::sin(a)),
                "I 1 GEAR N 1 3 KIND BEVEL Z 18 12 MN 4 AXIS 0 0 1\nI 2 GEAR N 1 4 KIND BEVEL Z 18 12 MN 4 AXIS 0 0 1\n"
                "I 3 GEAR N 2 3 KIND BEVEL Z 18 12 MN 4 AXIS 0 0 1\nI 4 GEAR N 2 4 KIND BEVEL Z 18 12 MN 4 AXIS 0 0 1\n");
  };
  for (const double angle : {180.0, 90.0, 130.0}) EXPECT_FALSE(differential(angle).diagnostics.has_errors()) << angle;
  for (const double angle : {185.0, 95.0}) EXPECT_TRUE(differential(angle).diagnostics.has_errors()) << angle;
}

TEST(ToothPhases, WheelsOfDifferentTeethOnOneShaftAreFree) {
  // a stepped planet: its two wheels may be turned against each other when they are made, so nothing can misfit
  const Deck stepped(
      "I 1 X 40\nI 2 X (40*cos(2)) (40*sin(2))",
      "I 1 GEAR N 0 1 KIND SPUR Z 20 20 MN 2 AXIS 0 0 1\nI 2 GEAR N 0 2 KIND SPUR Z 20 20 MN 2 AXIS 0 0 1\n"
      "I 3 GEAR N 1 0 KIND INTERNAL Z 22 62 MN 2 AXIS 0 0 1\nI 4 GEAR N 2 0 KIND INTERNAL Z 22 62 MN 2 AXIS 0 0 1\n");
  EXPECT_FALSE(stepped.diagnostics.has_errors());
  // and so are the two halves of a double helical wheel
  const Deck arrow("I 1\nI 2",
                   "I 1 GEAR N 1 2 KIND HELICAL Z 20 40 MN 2 HELIX 30 AXIS 0 0 1 PLACE 1 0 0\n"
                   "I 2 GEAR N 1 2 KIND HELICAL Z 20 40 MN 2 HELIX -30 AXIS 0 0 1 PLACE 1 0 0\n");
  EXPECT_FALSE(arrow.diagnostics.has_errors());
  EXPECT_EQ(mesh(arrow, 2).phase, 0);
}

TEST(ToothPhases, PlanetsInEachOthersWay) {
  // tip radius 26 on an arm of 48: neighbours at 52/48 = 2 sin(φ/2) touch, φ = 65.6 degrees: five have room, six do not
  const Numbers z;
  EXPECT_FALSE(planetary({0, 67.5}, z).warned("run into each other"));
  EXPECT_TRUE(planetary({0, 63.75}, z).warned("run into each other"));
}

}  // namespace
}  // namespace engrane
