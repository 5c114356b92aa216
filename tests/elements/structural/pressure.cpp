// SPDX-License-Identifier: BSD-3-Clause
#include "elements/structural/pressure.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "elements/structural/deck_model.hpp"

namespace engrane::elements::structural {
namespace {

using namespace suite;

/// The pressure of a deck with one cell, whichever its kind.
struct Loaded : DeckModel {
  Loaded(const std::string& cell, const std::string& hypothesis, const std::string& analysis, int edge,
         const std::string& dead = "")
      : DeckModel(
            ".NOE\n I 1 X 1. Y 0.1\n I 2 X 2.3 Y -0.2\n I 3 X 2.1 Y 1.3\n I 4 X 0.8 Y 0.9\n I 5 X 1.7 Y 0.\n"
            " I 6 X 2.15 Y 0.6\n I 7 X 1.4 Y 1.05\n I 8 X 0.95 Y 0.5\n.MAI\n I 1 N " +
            cell + "\n.MAT\n I 1 YT 70 NT 0.3\n.AEL\n I 1 MAT 1\n.HYP " + hypothesis +
            "\n.SEL\n GROUP 1 MAILLES TOUT\n.PHP GROUP 1 THICK VAL 0.4\n.CLM ARETE I 1 " + std::to_string(edge) + " PRE V 3. " +
            dead + "\n" + analysis) {}
  const Element& pressure() const { return *model.parts.back().element; }
};

const std::string large_moves = ".SAM TYPE STATIC DISPLACEMENTS LARGE\n", small_moves = ".SAM TYPE STATIC DISPLACEMENTS SMALL\n";
const std::string four = "1 2 3 4", turned_four = "4 3 2 1", eight = "1 -5 2 -6 3 -7 4 -8";

TEST(EdgePressure, TangentsOfLargeDisplacements) {
  for (const std::string& cell : {four, turned_four, eight})
    for (const char* hypothesis : {"MEMB BIDIM", "AXIS"}) {
      const Loaded loaded(cell, hypothesis, large_moves, 2);
      Subject s;
      s.name = cell + " " + hypothesis;
      s.nodes = loaded.nodes();
      s.in_plane = true;
      s.length = 0.2;
      s.build = [&](const Mat3&) {
        static std::vector<std::unique_ptr<Loaded>> kept;
        kept.push_back(std::make_unique<Loaded>(cell, hypothesis, large_moves, 2));
        return std::move(kept.back()->model.parts.back().element);
      };
      s.skip[Check::lagrange] = "a load";
      for (const Check check : {Check::rigid, Check::zero, Check::equilibrium}) s.skip[check] = "a load pushes";
      s.skip[Check::rotated_copy] = "the deck is given";
      if (std::string(hypothesis) == "AXIS") s.skip[Check::objectivity] = "the axis stands still";
      run_suite(s);
    }
}

/// A dead pressure does not depend on the displacements; the rest of the suite holds too, but that forces turn with the body.
TEST(EdgePressure, DeadInLargeDisplacements) {
  for (const std::string& cell : {four, turned_four, eight})
    for (const char* hypothesis : {"MEMB BIDIM", "DEFO PLAN", "AXIS"}) {
      const Loaded at_rest(cell, hypothesis, small_moves, 2), loaded(cell, hypothesis, large_moves, 2, "DEAD");
      Subject s;
      s.name = cell + " " + hypothesis + ", dead";
      s.nodes = loaded.nodes();
      s.in_plane = true;
      s.length = 0.2;
      s.build = [&](const Mat3&) {
        static std::vector<std::unique_ptr<Loaded>> kept;
        kept.push_back(std::make_unique<Loaded>(cell, hypothesis, large_moves, 2, "DEAD"));
        return std::move(kept.back()->model.parts.back().element);
      };
      s.skip[Check::lagrange] = "a load";
      for (const Check check : {Check::rigid, Check::zero, Check::equilibrium}) s.skip[check] = "a load pushes";
      s.skip[Check::rotated_copy] = "the deck is given";
      s.skip[Check::objectivity] = "its direction is fixed in space";
      run_suite(s);

      const Element& element = loaded.pressure();
      EXPECT_TRUE(element.is_linear());
      const auto expected = residual_of(at_rest.pressure(), StateBuffer(at_rest.pressure(), loaded.nodes()));
      Random random(3);
      for (int i = 0; i < 3; ++i) {
        const StateBuffer state = random_state(s, element, random);
        EXPECT_EQ(residual_of(element, state), expected);
        for (const double slope : tangent_of(element, state, {1, 1, 1})) EXPECT_EQ(slope, 0);
      }
    }
}

TEST(EdgePressure, ResultantsAreThoseOfTheChord) {
  // the pressure on a curve pushes as that on the straight line between its ends
  const Vec3 ends[] = {{1, 0.1, 0}, {2.3, -0.2, 0}, {2.1, 1.3, 0}, {0.8, 0.9, 0}};
  for (int edge = 1; edge <= 4; ++edge)
    for (const std::string& cell : {four, eight}) {
      const Loaded loaded(cell, "DEFO PLAN", small_moves, edge);
      const StateBuffer state(loaded.pressure(), loaded.nodes());
      const auto r = residual_of(loaded.pressure(), state);
      Vec3 sum = Vec3::Zero();
      for (std::size_t i = 0; i < r.size(); i += 6) sum -= Vec3(r[i], r[i + 1], 0);
      const Vec3 along = ends[edge % 4] - ends[edge - 1];
      const Vec3 expected = -3 * 0.4 * Vec3(along[1], -along[0], 0);  // against the outward normal
      EXPECT_LT((sum - expected).norm(), 1e-14) << cell << ", edge " << edge;
    }
}

TEST(EdgePressure, RoundAnAxis) {
  const Loaded loaded(four, "AXIS", small_moves, 2);
  const StateBuffer state(loaded.pressure(), loaded.nodes());
  const auto r = residual_of(loaded.pressure(), state);
  // along the axis: the projected ring; the cell lies to the left of the edge from (2.3, −0.2) to (2.1, 1.3)
  EXPECT_NEAR(-r[1] - r[7], 3 * std::numbers::pi * (2.1 * 2.1 - 2.3 * 2.3), 1e-12);
}

}  // namespace
}  // namespace engrane::elements::structural
