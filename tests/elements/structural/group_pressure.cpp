// SPDX-License-Identifier: BSD-3-Clause
#include "elements/structural/group_pressure.hpp"

#include <gtest/gtest.h>

#include "elements/structural/deck_model.hpp"

namespace engrane::elements::structural {
namespace {

using namespace suite;

/// A solid, and a pressure of 3 on some of its faces.
std::string solid_deck(const std::string& cell, int nodes, const std::string& faces, const char* size, const char* dead = "") {
  const double x[8][3] = {{0, 0, 0},       {1.2, 0.1, 0}, {1.1, 0.9, 0.1}, {-0.1, 1, 0},
                          {0.1, 0.1, 0.8}, {1, 0, 1},     {1.2, 1.1, 0.9}, {0, 1.2, 1.1}};
  std::string text = ".NOE\n";
  for (int i = 0; i < std::min(nodes, 8); ++i)
    text += " I " + std::to_string(i + 1) + " X " + std::to_string(x[i][0]) + " Y " + std::to_string(x[i][1]) + " Z " +
            std::to_string(x[i][2]) + "\n";
  if (nodes == 10) {  // of a tetrahedron, one side bent
    text.resize(text.find(" I 5 "));
    text +=
        " I 5 X 0.6 Y 0.05\n I 6 X 1.2 Y 0.5 Z 0.07\n I 7 X 0.5 Y 0.4 Z 0.05\n"
        " I 8 X -0.05 Y 0.5\n I 9 X 0.5 Y 0.6\n I 10 X 0.5 Y 1. Z 0.1\n";
  }
  return text + ".MAI\n I 1 N " + cell + "\n.MAT\n I 1 YT 70 NT 0.3\n.AEL\n I 1 MAT 1\n.SEL GROUP 1 NOM \"skin\" FACES\n" +
         faces + ".CLM\n GROUP \"skin\" PRE V 3. " + dead + "\n.SAM TYPE STATIC DISPLACEMENTS " + size + "\n";
}

struct FacedCell {
  const char* cell;
  int nodes, faces;
};
const FacedCell kinds[] = {
    {"1 2 3 0 4", 4, 4}, {"3 2 1 0 4", 4, 4}, {"1 2 4 0 5 6 8", 8, 5}, {"1 2 3 4 0 5 6 7 8", 8, 6}, {"4 3 2 1 0 8 7 6 5", 8, 6}};

std::string all_faces(int count) {
  std::string rows;
  for (int i = 1; i <= count; ++i) rows += " I 1 " + std::to_string(i) + "\n";
  return rows;
}

/// The same pressure on all faces pushes nowhere and turns nothing; a row of the group is an element.
TEST(GroupPressure, OnAClosedSkinIsInBalance) {
  for (const char* size : {"SMALL", "LARGE"})
    for (const FacedCell& kind : kinds) {
      const DeckModel solid(solid_deck(kind.cell, kind.nodes, all_faces(kind.faces), size));
      ASSERT_EQ(solid.model.parts.size(), static_cast<std::size_t>(1 + kind.faces));
      Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
      double each = 0;
      for (std::size_t p = 1; p < solid.model.parts.size(); ++p) {
        const Element& element = *solid.model.parts[p].element;
        const StateBuffer state(element, solid.nodes());
        std::vector<double> forces(3 * element.node_ids().size());
        ASSERT_TRUE(element.applied(state.view(), forces));
        for (std::size_t i = 0; i < element.node_ids().size(); ++i) {
          const Vec3 f(forces[3 * i], forces[3 * i + 1], forces[3 * i + 2]);
          force += f;
          moment += state.nodes[i].x.cross(f);
          each = std::max(each, f.norm());
        }
      }
      EXPECT_GT(each, 0.1);
      EXPECT_LT(force.norm(), 1e-14) << kind.cell;
      EXPECT_LT(moment.norm(), 1e-14) << kind.cell;
    }
}

/// Pushes into the cell, whichever way its corners go round.
TEST(GroupPressure, PushesInward) {
  for (const FacedCell& kind : {FacedCell{"1 2 3 4 0 5 6 7 8", 8, 6}, FacedCell{"4 3 2 1 0 8 7 6 5", 8, 6}}) {
    const DeckModel solid(solid_deck(kind.cell, kind.nodes, " I 1 6\n", "SMALL"));  // the top
    const Element& element = *solid.model.parts.back().element;
    std::vector<double> forces(12);
    element.applied(StateBuffer(element, solid.nodes()).view(), forces);
    EXPECT_LT(forces[2] + forces[5] + forces[8] + forces[11], -2);
  }
}

TEST(GroupPressure, TangentsOfLargeDisplacements) {
  std::vector<std::pair<FacedCell, int>> cases{{{"1 -5 2 -6 3 -7 0 -8 -9 -10 0 4", 10, 4}, 2}};
  for (const FacedCell& kind : kinds) cases.emplace_back(kind, kind.faces);
  for (const auto& [kind, face] : cases) {
    const std::string row = " I 1 " + std::to_string(face) + "\n";
    const DeckModel solid(solid_deck(kind.cell, kind.nodes, row, "LARGE"));
    Subject s;
    s.name = kind.cell;
    s.nodes = solid.nodes();
    s.length = 0.2;
    s.build = [kind = kind, row](const Mat3&) {
      static std::vector<std::unique_ptr<DeckModel>> kept;
      kept.push_back(std::make_unique<DeckModel>(solid_deck(kind.cell, kind.nodes, row, "LARGE")));
      return std::move(kept.back()->model.parts.back().element);
    };
    s.skip[Check::lagrange] = "a load";
    for (const Check check : {Check::rigid, Check::zero, Check::equilibrium}) s.skip[check] = "a load pushes";
    s.skip[Check::rotated_copy] = "built by a deck in its place";
    run_suite(s);
  }
}

/// A dead pressure is that of the reference configuration, however the solid moves, and so is that on a membrane.
TEST(GroupPressure, DeadInLargeDisplacements) {
  const std::string skin =
      ".NOE\n I 1 X 0 Y 0 Z 0\n I 2 X 1.2 Y 0.1 Z 0\n I 3 X 1.1 Y 0.9 Z 0.1\n I 4 X -0.1 Y 1 Z 0\n.MAI\n I 1 N 1 2 3 4\n"
      ".MAT\n I 1 YT 70 NT 0.3\n.AEL\n I 1 MAT 1\n.HYP MEMBRANE\n.SEL GROUP 1 NOM \"skin\" MAILLES TOUT\n"
      ".PHP GROUP 1 THICK VAL 0.1\n.SAM TYPE STATIC\n.CLM\n GROUP \"skin\" PRE V 3. ";
  std::vector<std::pair<std::string, std::string>> decks{{skin, skin + "DEAD\n"}};
  for (const FacedCell& kind : kinds) {
    const std::string row = " I 1 " + std::to_string(kind.faces) + "\n";
    decks.emplace_back(solid_deck(kind.cell, kind.nodes, row, "SMALL"), solid_deck(kind.cell, kind.nodes, row, "LARGE", "DEAD"));
  }
  for (const auto& [at_rest_text, dead_text] : decks) {
    const DeckModel at_rest(at_rest_text), dead(dead_text);
    const Element &first = *at_rest.model.parts.back().element, &element = *dead.model.parts.back().element;
    const auto expected = residual_of(first, StateBuffer(first, dead.nodes()));
    Subject s;
    s.name = dead_text;
    s.nodes = dead.nodes();
    s.length = 0.2;
    s.build = [text = dead_text](const Mat3&) {
      static std::vector<std::unique_ptr<DeckModel>> kept;
      kept.push_back(std::make_unique<DeckModel>(text));
      return std::move(kept.back()->model.parts.back().element);
    };
    s.skip[Check::lagrange] = "a load";
    for (const Check check : {Check::rigid, Check::zero, Check::equilibrium}) s.skip[check] = "a load pushes";
    s.skip[Check::rotated_copy] = "built by a deck in its place";
    s.skip[Check::objectivity] = "its direction is fixed in space";
    run_suite(s);
    Random random(3);
    const StateBuffer state = random_state(s, element, random);
    EXPECT_EQ(residual_of(element, state), expected);
    for (const double slope : tangent_of(element, state, {1, 1, 1})) EXPECT_EQ(slope, 0);
  }
}

}  // namespace
}  // namespace engrane::elements::structural
