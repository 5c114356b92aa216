// SPDX-License-Identifier: BSD-3-Clause
#include "elements/structural/rigid_link.hpp"

#include <gtest/gtest.h>

#include "elements/structural/deck_model.hpp"
#include "math/rotation.hpp"

namespace engrane::elements::structural {
namespace {

using namespace suite;

TEST(RigidLink, Suite) {
  Subject s;
  s.name = "in space";
  s.nodes = {{1, {1, 0.2, -0.3}}, {2, {-0.5, 0.4, 0.8}}};
  s.build = [&](const Mat3& Q) {
    RigidLinkData data;
    data.master = 1;
    data.nodes = {2};
    return build(rigid_link_type(), data, turned(s.nodes, Q));
  };
  s.own_axes = true;
  run_suite(s);
}

const std::string plate =
    ".NOE\n I 1 X 0 Y 0\n I 2 X 1 Y 0.1\n I 3 X 1.2 Y 1\n I 4 X 0.1 Y 0.9\n I 9 X 0.3 Y 0.4\n.MAI\n I 1 N 1 2 3 4\n"
    ".MAT\n I 1 YT 70 NT 0.3\n.AEL\n I 1 MAT 1\n.HYP MEMB BIDIM\n.SEL\n GROUP 1 MAILLES TOUT\n.PHP GROUP 1 THICK VAL 1.\n.MCE\n "
    "I 7 RIGID_LINK N 9 MEMBERS 2 3\n";

TEST(RigidLink, SuiteInThePlane) {
  Subject s;
  s.name = "in the plane";
  s.in_plane = true;
  s.nodes = DeckModel(plate).nodes();
  s.build = [](const Mat3&) { return std::move(DeckModel(plate).model.parts.back().element); };
  s.own_axes = true;
  s.skip[Check::rotated_copy] = "the deck is given";
  s.adjust = [](StateBuffer& state, Random& random) {  // N stays in the plane, too
    NodeState& master = state.nodes[0];
    master.W = uniform(random) * Vec3::UnitZ();
    master.A = uniform(random) * Vec3::UnitZ();
    state.turn(0, rotation_exp(Vec3(2 * uniform(random) * Vec3::UnitZ())), 0.4 * uniform(random) * Vec3::UnitZ());
  };
  run_suite(s);
}

TEST(RigidLink, CostsThreeConstraintsANodeAndTwoInThePlane) {
  const DeckModel deck(plate);
  int links = 0;
  for (const Model::Part& part : deck.model.parts) {
    if (part.type != "RIGID_LINK") continue;
    ++links;
    EXPECT_EQ(part.element->layout().own_multipliers(), 2u);
    EXPECT_EQ(part.nodes.size(), 2u);
  }
  EXPECT_EQ(links, 2);
}

}  // namespace
}  // namespace engrane::elements::structural
