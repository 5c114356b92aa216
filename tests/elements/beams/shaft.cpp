// SPDX-License-Identifier: BSD-3-Clause
#include "elements/beams/shaft.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "elements/structural/deck_model.hpp"
#include "model/masses.hpp"

namespace engrane::elements::beams {
namespace {

using suite::DeckModel;

constexpr double pi = std::numbers::pi;

/// Three steps along a line across space, the second hollow, the third a cone, with a station within the second.
const char* const stepped = R"(.NOE
 I 1 X 1 0 0
 I 5 X 1.1 0.2 0.2
 I 7 X 1.2 0.4 0.4
.MAT
 I 3 YT 2.1D11 NT 0.3 M 7800.
.MCE
 I 4 SHAFT N 1 5 7 MAT 3 D 0.06 0.05 0.04 D_END 0.06 0.05 0.02 AT 0.15 0.45 BORE 0 0.02 0 DISC 5 M 2 JP 0.01 JD 0.006 $
  WHEEL 7 OUTER 0.2 WIDTH 0.03 DENSITY 1000 BEARING 1 7 KR 1D8 2D8 KA 3D7 0 CR 5
.FIN 1
)";

TEST(Shaft, BecomesOtherElements) {
  const DeckModel deck(stepped);
  std::vector<std::string> parts;
  for (const Model::Part& part : deck.model.parts) {
    parts.push_back(part.type + " " + std::to_string(part.element->id()));
    for (const int node : part.element->node_ids()) parts.back() += " " + std::to_string(node);
  }
  EXPECT_EQ(parts,
            (std::vector<std::string>{"BEAM 4 1 8 9", "BEAM 5 9 10 5", "BEAM 6 5 11 12", "BEAM 7 12 13 14", "BEAM 8 14 15 7",
                                      "INERTIA 9 5", "INERTIA 10 7", "BEARING 11 0 1", "BEARING 12 0 7"}));
  EXPECT_LE((deck.nodes().at(12) - Vec3(1.15, 0.3, 0.3)).norm(), 1e-15);
  EXPECT_LE((deck.nodes().at(11) - Vec3(1.125, 0.25, 0.25)).norm(), 1e-15);
}

TEST(Shaft, WheelsAreDrawn) {
  const DeckModel deck(stepped);
  std::vector<Drawing> bodies;
  for (const Model::Part& part : deck.model.parts)
    if (part.type == "INERTIA") bodies.push_back(part.element->drawing());
  ASSERT_EQ(bodies.size(), 2U);
  EXPECT_EQ(bodies[0], Drawing{R"("shape": "mass", "node": 5)"});
  EXPECT_EQ(bodies[1].front().find(R"("shape": "disc", "node": 7, "center": [1.2, 0.4, 0.4], "axis": [0.333)"), 0U);
  EXPECT_NE(bodies[1].front().find(R"("outer": 0.2, "inner": 0.02, "width": 0.03)"), std::string::npos);
}

/// Mass and moment of inertia about the axis of cylinders and a cone; moments across it of a disc and a wheel.
TEST(Shaft, Masses) {
  const DeckModel deck(stepped);
  MassProperties shaft, on_it;
  for (const Model::Part& part : deck.model.parts) (part.type == "BEAM" ? shaft : on_it).add(mass_properties(deck.model, part));
  const double cone = pi / 12 * 0.15 * (0.04 * 0.04 + 0.04 * 0.02 + 0.02 * 0.02);
  const double mass = 7800 * (pi / 4 * (0.15 * 0.06 * 0.06 + 0.3 * (0.05 * 0.05 - 0.02 * 0.02)) + cone);
  EXPECT_NEAR(shaft.mass, mass, 1e-13 * mass);
  const Vec3 axis = Vec3(1, 2, 2) / 3;
  const double of_cone = pi / 160 * 0.15 * (std::pow(0.04, 5) - std::pow(0.02, 5)) / (0.04 - 0.02);
  const double polar = 7800 * (pi / 32 * (0.15 * std::pow(0.06, 4) + 0.3 * (std::pow(0.05, 4) - std::pow(0.02, 4))) + of_cone);
  EXPECT_NEAR(axis.dot(shaft.inertia * axis), polar, 1e-3 * polar);  // of the cone by Simpson's rule
  const double wheel = 1000 * pi / 4 * (0.2 * 0.2 - 0.02 * 0.02) * 0.03, wheel_polar = wheel * (0.2 * 0.2 + 0.02 * 0.02) / 8;
  EXPECT_NEAR(on_it.mass, 2 + wheel, 1e-12);
  EXPECT_NEAR(axis.dot(on_it.inertia * axis), 0.01 + wheel_polar, 1e-14);
  const Vec3 across = Vec3(2, -2, 1) / 3;
  const double apart = 0.3 * 0.3 * 2 * wheel / (2 + wheel);
  EXPECT_NEAR(across.dot(on_it.inertia * across), 0.006 + wheel_polar / 2 + wheel * 0.03 * 0.03 / 12 + apart, 1e-13);
}

}  // namespace
}  // namespace engrane::elements::beams
