// SPDX-License-Identifier: BSD-3-Clause
#include "model/masses.hpp"

#include <gtest/gtest.h>

#include "deck/read/reader.hpp"

namespace engrane {
namespace {

/// The element with this number, in a deck of SI units.
MassProperties of(const std::string& text, int id) {
  SourceMap sources;
  Diagnostics diagnostics;
  const deck::Deck deck = deck::read_text("masses", text, catalogue(element_types()), sources, diagnostics);
  const Model model = build_model(deck, element_types(), diagnostics);
  EXPECT_FALSE(diagnostics.has_errors());
  for (const Model::Part& part : model.parts)
    if (part.element->id() == id) {
      EXPECT_EQ(mass_of(model, part), mass_properties(model, part).mass);
      return mass_properties(model, part);
    }
  ADD_FAILURE() << "no element " << id;
  return {};
}

constexpr const char* nodes = ".NOE\n I 1 X 1 2 3\n I 2 X -4 0 1\n I 3 X 5 5 5\n.MCE\n";

TEST(Masses, OfABody) {
  const MassProperties body = of(std::string(nodes) + " I 1 INERTIA N 1 M 7 J 3 4 5", 1);
  EXPECT_NEAR(body.mass, 7, 1e-13);
  EXPECT_NEAR((body.centre - Vec3(1, 2, 3)).norm(), 0, 1e-12);
  EXPECT_NEAR((body.inertia - Mat3(Vec3(3, 4, 5).asDiagonal())).norm(), 0, 1e-11);
}

TEST(Masses, WithoutTurning) {
  const MassProperties point = of(std::string(nodes) + " I 1 INERTIA N 2 M 7", 1);
  EXPECT_NEAR(point.mass, 7, 1e-13);
  EXPECT_NEAR((point.centre - Vec3(-4, 0, 1)).norm(), 0, 1e-12);
  EXPECT_TRUE(point.inertia.isZero(0));
}

TEST(Masses, OfWhatHasNone) {
  EXPECT_FALSE(of(std::string(nodes) + " I 1 SPRING N 1 2 K 5 C 3\n I 2 INERTIA N 1 M 1", 1).any());
  EXPECT_FALSE(of(std::string(nodes) + " I 1 HINGE N 1 2 AXIS 0 0 1 AT 0 0 0\n I 2 INERTIA N 1 M 1", 1).any());
}

/// Two balls of 2 and 3 kg: their reduced mass 6/5 turns with their distance (-5, -2, -2).
TEST(Masses, AddUp) {
  MassProperties sum = of(std::string(nodes) + " I 1 INERTIA N 1 M 2 J 1", 1);
  sum.add(of(std::string(nodes) + " I 1 INERTIA N 2 M 3 J 1", 1));
  EXPECT_NEAR(sum.mass, 5, 1e-13);
  EXPECT_NEAR((sum.centre - Vec3(-2, 0.8, 1.8)).norm(), 0, 1e-12);
  const Vec3 d(-5, -2, -2);
  const Mat3 expected = 2 * Mat3::Identity() + 1.2 * (33 * Mat3::Identity() - d * d.transpose());
  EXPECT_NEAR((sum.inertia - expected).norm(), 0, 1e-10);
}

}  // namespace
}  // namespace engrane
