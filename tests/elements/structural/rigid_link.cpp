// SPDX-License-Identifier: BSD-3-Clause
#include "elements/structural/rigid_link.hpp"

#include <fmt/format.h>
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

/// Shares of links among cells with small displacements: constraints, and forces and moments in space, are linear however far
/// the master turns.
TEST(RigidLink, SmallDisplacements) {
  for (const std::string link : {"RIGID_LINK", "MEAN_LINK"}) {
    Subject s;
    s.name = "small " + link;
    s.nodes = {{1, {1, 0.2, -0.3}}, {2, {-0.5, 0.4, 0.8}}};
    s.build = [&](const Mat3& Q) {
      std::string text = ".NOE\n";
      NodeMap all = s.nodes;
      all[3] = {0.6, 0.1, 0.2};
      all[4] = {-0.2, 1.1, -0.4};
      for (const auto& [id, place] : turned(all, Q)) text += fmt::format(" I {} X {} {} {}\n", id, place[0], place[1], place[2]);
      DeckModel deck(text + ".MCE\n I 7 " + link + " N 1 MEMBERS 2 3 4\n.SAM TYPE STATIC DISPLACEMENTS SMALL\n.FIN 1\n");
      return std::move(deck.model.parts.at(0).element);
    };
    s.own_axes = true;
    for (const Check check :
         {Check::ideal, Check::lagrange, Check::power, Check::rigid, Check::objectivity, Check::equilibrium, Check::rotated_copy})
      s.skip[check] = "rotations and displacements are small, constraints along the axes of space";
    run_suite(s);
    const auto element = s.build(Mat3::Identity());
    EXPECT_TRUE(element->is_linear());
    StateBuffer state(*element, s.nodes);
    for (std::size_t m = 0; m < state.multipliers.size(); ++m) state.multipliers[m] = 0.3 * static_cast<double>(m) - 0.4;
    std::vector<std::vector<double>> found;
    for (const double size : {0.0, 1.0, 2.0}) {
      state.nodes[1].x = s.nodes.at(2) + size * Vec3(0.1, -0.2, 0.15);
      state.turn(0, rotation_exp(size * Vec3(0.3, 0.4, -0.2)), Vec3::Zero());
      found.push_back(residual_of(*element, state));
      Vec3 moment(&found.back()[3]);
      moment = state.nodes[0].R * moment;
      std::copy(moment.data(), moment.data() + 3, &found.back()[3]);
    }
    for (std::size_t i = 0; i < found[0].size(); ++i)
      EXPECT_NEAR(found[2][i] - found[1][i], found[1][i] - found[0][i], 1e-14) << i;
  }
}

const std::string plate =
    ".NOE\n I 1 X 0 Y 0\n I 2 X 1 Y 0.1\n I 3 X 1.2 Y 1\n I 4 X 0.1 Y 0.9\n I 9 X 0.3 Y 0.4\n.MAI\n I 1 N 1 2 3 4\n"
    ".MAT\n I 1 YT 70 NT 0.3\n.AEL\n I 1 MAT 1\n.HYP MEMB BIDIM\n.SEL\n GROUP 1 MAILLES TOUT\n.PHP GROUP 1 THICK VAL 1.\n.MCE\n "
    "I 7 RIGID_LINK N 9 MEMBERS 2 3\n.SAM TYPE STATIC DISPLACEMENTS LARGE\n.SUB TF 1 H 1\n";

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
