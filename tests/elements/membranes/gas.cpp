// SPDX-License-Identifier: BSD-3-Clause
#include "elements/membranes/gas.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "elements/membranes/volume_shares.hpp"
#include "elements/structural/deck_model.hpp"
#include "elements/suite.hpp"

namespace engrane::elements::membranes {
namespace {

using namespace suite;

/// A tetrahedron of membranes round a gas.
const std::string tetrahedron =
    ".NOE\n I 1 X 0 0 0\n I 2 X 3 0 0\n I 3 X 0 2 0\n I 4 X 0 0 4\n"
    ".MAT\n I 1 YT 100. NT 0.3 M 1.\n"
    ".MCE\n I 1 MEMBRANE N 1 3 2 MAT 1 THICK 0.1\n I 2 MEMBRANE N 1 2 4 MAT 1 THICK 0.1\n"
    " I 3 MEMBRANE N 2 3 4 MAT 1 THICK 0.1\n I 4 MEMBRANE N 3 1 4 MAT 1 THICK 0.1\n"
    ".SEL\n GROUP 1 NOM \"skin\" MAILLES\n I 1 J 4 K 1\n";

const Element& part(const DeckModel& deck, std::size_t which) {
  for (const Model::Part& p : deck.model.parts)
    if (p.type == "GAS" && which-- == 0) return *p.element;
  throw std::out_of_range("no such part");
}

/// A gas by itself, whose law is what `card` says.
Subject gas(const std::string& card) {
  static std::vector<std::unique_ptr<DeckModel>> decks;
  Subject s;
  s.name = card;
  s.build = [card](const Mat3&) -> std::unique_ptr<Element> {
    decks.push_back(std::make_unique<DeckModel>(tetrahedron + ".MCE\n I 9 GAS GROUP \"skin\" " + card +
                                                "\n.FCT\n I 1 SINUS 0.4 0.3 20. 1.5\n.SAM TYPE STATIC\n.SUB TF 1 H 1\n"));
    for (Model::Part& p : decks.back()->model.parts)
      if (p.type == "GAS") return std::move(p.element);
    return nullptr;
  };
  s.scalar = 0.02;
  s.length = s.velocity = 0.02;  // of a height of 0.2
  s.skip[Check::zero] = s.skip[Check::rigid] = "it is under pressure, and its membranes are elsewhere";
  return s;
}

TEST(Gas, Suite) {
  run_suite(gas("P 7 AMBIENT 3"));
  run_suite(gas("P 7 AMBIENT 3 GAMMA 1.4"));
  run_suite(gas("MASS 2 NF 1 R 3 TEMP 5 AMBIENT 2"));
  run_suite(gas("MASS 2 NF 1 R 3 TEMP 5"));
}

/// Shares of cells and of the rim, in any state.
TEST(Gas, SuiteOfShares) {
  const std::vector<Vec3> places = {{0.1, 0, 0.2},    {1.2, 0.1, -0.1}, {1.3, 1.2, 0.3}, {0, 0.9, 0.2},
                                    {0.6, -0.1, 0.1}, {1.4, 0.6, 0.15}, {0.7, 1.1, 0.3}, {0.1, 0.4, 0.1}};
  for (const bool rim : {false, true})
    for (const std::size_t nodes : rim ? std::vector<std::size_t>{2, 3} : std::vector<std::size_t>{3, 4, 6, 8}) {
      Subject s;
      s.name = std::to_string(nodes) + (rim ? " nodes of the rim" : " nodes");
      for (std::size_t i = 0; i < nodes; ++i) s.nodes[static_cast<int>(i) + 1] = places[i];
      s.build = [=](const Mat3& Q) {
        const auto block = std::make_shared<VolumeShares>(
            nodes, rim, std::vector<Multiplier>{{{"PRESSURE_FORCE", dimension::length, ""}, Role::other}});
        VolumeShares::Piece piece{{}, Q * Vec3(0.3, 0.4, -0.5), Q * Vec3(0.6, 0, 0.8), 2};
        for (std::size_t i = 0; i < nodes; ++i) piece.nodes.push_back(static_cast<int>(i) + 1);
        return std::make_unique<BlockMember>(1, block, block->add(piece));
      };
      s.length = 0.1;
      for (const Check check : {Check::zero, Check::rigid, Check::equilibrium})
        s.skip[check] = "one share is a volume from a fixed point, and grows as it is moved";
      s.skip[Check::objectivity] = "likewise";
      s.skip[Check::rotated_copy] = "a share has no penalty";
      run_suite(s);
    }
}

/// A cap of cells over a square hole in the plane z = 0: the forces of cones and rim are those of the pressure on the cells.
TEST(Gas, RimFeelsThePressureOnItsCells) {
  const std::vector<Vec3> x = {{1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}, {0.2, 0.1, 1.5}};
  std::vector<Vec3> force(5, Vec3::Zero()), wanted = force;
  const auto add = [&](const std::vector<int>& nodes, bool rim) {
    VolumeShares block(nodes.size(), rim, {{{"PRESSURE_FORCE", dimension::length, ""}, Role::other}});
    block.add({nodes, Vec3::Zero(), Vec3::UnitZ(), 1});
    std::vector<NodeState> states(nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) states[i].x = x[static_cast<std::size_t>(nodes[i])];
    const std::vector<double> one = {1.0};
    State state;
    state.nodes = states;
    state.multipliers = one;
    std::vector<double> r(3 * nodes.size() + 1);
    block.residual(0, {&state, 1}, r);
    for (std::size_t i = 0; i < nodes.size(); ++i) force[static_cast<std::size_t>(nodes[i])] -= Vec3(&r[3 * i]);
  };
  for (int i = 0; i < 4; ++i) {
    const int j = (i + 1) % 4;
    add({i, j, 4}, false);
    add({i, j}, true);
    const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
    const Vec3 third = (x[b] - x[a]).cross(x[4] - x[a]) / 6;
    for (const std::size_t node : {a, b, std::size_t{4}}) wanted[node] += third;
  }
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_LT((force[i] - wanted[i]).norm(), 1e-14) << i;
    sum += force[i];
  }
  EXPECT_LT((sum - Vec3(0, 0, 4)).norm(), 1e-14) << "pressure times the area of the hole";
}

TEST(Gas, StartsWithTheVolumeOfItsMembranes) {
  const DeckModel deck(tetrahedron + ".MCE\n I 9 GAS GROUP 1 P 7 AMBIENT 3\n.SAM TYPE STATIC\n.SUB TF 1 H 1\n");
  const Element& element = part(deck, 0);
  EXPECT_NEAR(element.derived()[0].value, 3 * 2 * 4 / 6.0, 1e-13);
  EXPECT_EQ(part(deck, 4).layout().shares_multipliers, true);
  EXPECT_EQ(part(deck, 1).node_ids().size(), 3u);
}

}  // namespace
}  // namespace engrane::elements::membranes
