// SPDX-License-Identifier: BSD-3-Clause
// Only what a scene requires is unknown: twelve scenes with the numbers of their unknowns, found by hand.
#include "run_deck.hpp"

namespace engrane::test {
namespace {

struct Scene {
  const char* name;
  const char* deck;
  int motions, multipliers;                      ///< in space
  int plane_motions = 0, plane_multipliers = 0;  ///< with PLANE XY; no motions: the scene is not of the plane
};

void PrintTo(const Scene& scene, std::ostream* out) { *out << scene.name; }

class ScenesTest : public testing::TestWithParam<Scene> {};

/// Motion unknowns and multipliers that have equations.
std::pair<int, int> unknowns(const std::string& deck) {
  DeckRun run(deck);
  int motions = 0, multipliers = 0;
  for (const Unknown& u : run.context().numbering.unknowns()) ++(u.multiplier ? multipliers : motions);
  return {motions, multipliers};
}

TEST_P(ScenesTest, UnknownsAreThoseFoundByHand) {
  const Scene& scene = GetParam();
  const std::string deck = scene.deck;
  EXPECT_EQ(unknowns(deck + "\n.SAM TYPE DYNAMIC\n.SUB TF 1 H 0.1\n"), std::pair(scene.motions, scene.multipliers));
  const std::string in_plane = deck + "\n.SAM TYPE DYNAMIC PLANE XY\n.SUB TF 1 H 0.1\n";
  if (scene.plane_motions > 0)
    EXPECT_EQ(unknowns(in_plane), std::pair(scene.plane_motions, scene.plane_multipliers));
  else
    EXPECT_THROW(unknowns(in_plane), std::runtime_error);
}

// clang-format off
INSTANTIATE_TEST_SUITE_P(Twelve, ScenesTest, testing::Values(
  // two point masses do not turn: three translations each; two of them in the plane
  Scene{"masses_and_springs", ".NOE\n I 1 X 1\n I 2 X 2\n.MCE\n I 1 INERTIA N 1 M 1\n I 2 INERTIA N 2 M 1\n"
        " I 3 SPRING N 0 1 K 10\n I 4 SPRING N 1 2 K 10\n", 6, 0, 4, 0},
  // the same on a line: supports take y and z of both; the plane has nothing to add
  Scene{"oscillators_on_a_line", ".NOE\n I 1 X 1\n I 2 X 2\n.MCE\n I 1 INERTIA N 1 M 1\n I 2 INERTIA N 2 M 1\n"
        " I 3 SPRING N 0 1 K 10\n I 4 SPRING N 1 2 K 10\n.CLM\n FIX NOEUD 1 2 C 2 3\n", 2, 0, 2, 0},
  // a body and a hinge: 6 motions, 5 constraints; in the plane x, y, turn, and the pin's two forces
  Scene{"pendulum", ".NOE\n I 1 X 1\n.MCE\n I 1 HINGE N 0 1 AXIS 0 0 1 AT 0 0 0\n I 2 INERTIA N 1 M 1 J 1 1 1\n", 6, 5, 3, 2},
  // a slide along a direction of the plane keeps the force across it and the moment: 2 of 5
  Scene{"slide", ".NOE\n I 1 X 1\n.MCE\n I 1 PRISMATIC N 0 1 AXIS 3 4 0\n I 2 INERTIA N 1 M 1 J 1 1 1\n", 6, 5, 3, 2},
  // a drive is one constraint more, in the plane too
  Scene{"driven_crank", ".NOE\n I 1 X 0\n.MCE\n I 1 HINGE N 0 1 AXIS 0 0 1 DRIVE SPEED NF 1\n I 2 INERTIA N 1 M 1 J 1 1 1\n"
        ".FCT\n I 1 EXPR \"2\"\n", 6, 6, 3, 3},
  // three bodies, four hinges: 18 and 20, three constraints too many; in the plane 9 and 8, one freedom and none too many
  Scene{"four_bar", ".NOE\n I 1 X 0\n I 2 X 0.2 0.5\n I 3 X 2\n.MCE\n I 1 HINGE N 0 1 AXIS 0 0 1\n"
        " I 2 HINGE N 1 2 AXIS 0 0 1 AT 0 1 0\n I 3 HINGE N 2 3 AXIS 0 0 1 AT 2 1.5 0\n I 4 HINGE N 3 0 AXIS 0 0 1 AT 2 0 0\n"
        " I 5 INERTIA N 1 M 1 J 1 1 1\n I 6 INERTIA N 2 M 1 J 1 1 1\n I 7 INERTIA N 3 M 1 J 1 1 1\n", 18, 20, 9, 8},
  // crank, rod and slider: 3 hinges and a slide, 18 and 20; in the plane 9 and 3 x 2 + 2
  Scene{"slider_crank", ".NOE\n I 1 X 0\n I 2 X 2 0.5\n I 3 X 4\n.MCE\n I 1 HINGE N 0 1 AXIS 0 0 1\n"
        " I 2 HINGE N 1 2 AXIS 0 0 1 AT 0 1 0\n I 3 HINGE N 2 3 AXIS 0 0 1 AT 4 0 0\n I 4 PRISMATIC N 0 3 AXIS 1 0 0\n"
        " I 5 INERTIA N 1 M 1 J 1 1 1\n I 6 INERTIA N 2 M 1 J 1 1 1\n I 7 INERTIA N 3 M 1 J 1 1 1\n", 18, 20, 9, 8},
  // a rigid link joins two whole nodes, 12 and 6; in the plane 6 and 3
  Scene{"rigid_link", ".NOE\n I 1 X 0\n I 2 X 1 1\n.MCE\n I 1 RIGID N 1 2 M 1 J 1 1 1\n I 2 SPRING N 0 2 AT 3 0 0 K 5\n"
        " I 3 TSPRING N 0 2 AXIS 0 0 1 K 1\n", 12, 6, 6, 3},
  // a ball at a mass point holds three translations and no turn, 3 and 3; in the plane 2 and 2
  Scene{"ball_at_a_point", ".NOE\n I 1 X 1\n.MCE\n I 1 SPHERICAL N 0 1\n I 2 INERTIA N 1 M 1\n", 3, 3, 2, 2},
  // wheels on hinges, rigid straight teeth: 12 and 2 x 5, and of the pair 2 angles with their 2 constraints and the tooth; in the
  // plane 6 and 2 x 2
  Scene{"spur_pair", ".NOE\n I 1 X 0\n I 2 X 90\n.MCE\n I 1 GEAR N 1 2 KIND SPUR Z 20 40 DISTANCE 90 AXIS 0 0 1\n"
        " I 2 HINGE N 0 1 AXIS 0 0 1\n I 3 HINGE N 0 2 AXIS 0 0 1\n I 4 INERTIA N 1 M 1 J 1 1 1\n I 5 INERTIA N 2 M 1 J 1 1 1\n",
        14, 13, 8, 7},
  // helical teeth push along the axles, which the hinges hold: the same numbers
  Scene{"helical_pair", ".NOE\n I 1 X 0\n I 2 X 90\n.MCE\n I 1 GEAR N 1 2 KIND HELICAL BETA 20 Z 20 40 DISTANCE 90 AXIS 0 0 1\n"
        " I 2 HINGE N 0 1 AXIS 0 0 1\n I 3 HINGE N 0 2 AXIS 0 0 1\n I 4 INERTIA N 1 M 1 J 1 1 1\n I 5 INERTIA N 2 M 1 J 1 1 1\n",
        14, 13, 8, 7},
  // a ball joint at the end of an arm turns its body: 6 and 3; in the plane 3 and 2, and a pull along z is refused in the next
  Scene{"conical_pendulum", ".NOE\n I 1 X 1\n.MCE\n I 1 SPHERICAL N 0 1 AT 0 0 0\n I 2 INERTIA N 1 M 1 J 1 1 1\n"
        ".CLM\n CHA NOEUD 1 C 3 V 1\n", 6, 3}),
  [](const auto& scene) { return std::string(scene.param.name); });
// clang-format on

/// What the messages of a wrong deck say.
std::string faults(const std::string& deck) {
  try {
    DeckRun run(deck);
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "";
}

TEST(Plane, EveryKindOfFaultIsNamed) {
  const std::string head = ".NOE\n I 1 X 1 0 0\n I 2 X 1 0 3\n.MCE\n I 2 INERTIA N 1 M 1 J 1 1 1\n";
  const std::string tail = ".SAM TYPE DYNAMIC PLANE XY\n.SUB TF 1 H 0.1\n";
  const std::string pin = " I 1 HINGE N 0 1 AXIS 0 0 1 AT 0 0 0\n";
  EXPECT_EQ(faults(head + pin + tail), "");
  struct Case {
    const char* lines;
    const char* expected;
  };
  for (const auto& [lines, expected] : {
           Case{" I 1 HINGE N 0 1 AXIS 0 1 1\n", "HINGE 1 is not of the plane XY"},
           Case{" I 3 RIGID N 1 2\n", "RIGID 3 is not of the plane XY"},
           Case{" I 3 FORCE N 1 DIR 0 0 1 V 1\n", "FORCE 3 is not of the plane XY: it pushes node 1 along z"},
           Case{" I 3 TORQUE N 1 AXIS 1 0 0 V 1\n", "TORQUE 3 is not of the plane XY: it turns node 1 about x"},
           Case{" I 3 INERTIA N 1 J 1 1 1 0 0.1 0\n", "INERTIA 3"},
           Case{" I 3 SPRING N 1 2 K 1\n", "SPRING 3 is not of the plane XY: it pushes node 1 along z"},
           Case{" I 1 HINGE N 0 1 AXIS 1 0 0 DRIVE SPEED NF 1\n.FCT\n I 1 EXPR \"1\"\n",
                "HINGE 1 moves its nodes out of the plane XY"},
           Case{".CLM\n STRU ACC VAL 0 0 -9.81\n", "gravity has a component normal to the plane XY"},
           Case{".CLM\n CHA NOEUD 1 C 3 V 1\n", "pushes node 1 along z"},
           Case{".CLM\n DEP NOEUD 1 C 3 V 1\n", "node 1 is prescribed a displacement out of the plane XY (component 3)"},
           Case{".INI\n VIT NOEUD 1 C 3 V 1\n", "the initial velocity of node 1 leads out of the plane XY (component 3)"},
           Case{".INI\n VIT NOEUD 1 AXIS 1 0 0 V 1\n", "the initial spin of node 1 leads out of the plane XY"},
       }) {
    const std::string text = faults(head + lines + tail);
    EXPECT_NE(text.find(expected), std::string::npos) << lines << text;
  }
}

}  // namespace
}  // namespace engrane::test
