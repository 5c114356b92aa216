// SPDX-License-Identifier: BSD-3-Clause
#include "elements/structural/mean_link.hpp"

#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <array>
#include <sstream>
#include <string>
#include <tuple>

#include "elements/structural/deck_model.hpp"
#include "math/rotation.hpp"

namespace engrane::elements::structural {
namespace {

using namespace suite;

const NodeMap linked_nodes = {{1, {1, 0.2, -0.3}}, {2, {-0.5, 0.4, 0.8}}, {3, {0.6, 0.1, 0.2}}, {4, {-0.2, 1.1, -0.4}}};

TEST(MeanLink, SuiteOfAShare) {
  Subject s;
  s.name = "in space";
  s.nodes = linked_nodes;
  s.build = [&](const Mat3& Q) {
    MeanLinkData data;
    data.master = 1;
    data.nodes = {2, 3, 4};
    data.weights = {1, 2, 0.5};
    return build(mean_link_type(), data, turned(s.nodes, Q));
  };
  s.own_axes = true;
  s.skip[Check::rotated_copy] = "the constraints' components are along its own axes, and a share has no penalty";
  run_suite(s);
}

/// The shares of a link between node 1 and nodes 2, 3 and 4.
const std::string deck_of_places =
    ".NOE\n I 1 X 1 Y 0.2 Z -0.3\n I 2 X -0.5 Y 0.4 Z 0.8\n I 3 X 0.6 Y 0.1 Z 0.2\n I 4 X -0.2 Y 1.1 Z -0.4\n"
    ".MCE\n I 7 MEAN_LINK N 1 MEMBERS 2 3 4 W 1. 2. 0.5\n I 8 SPHERICAL N 0 1 AT 0 0 0\n.SAM TYPE STATIC\n.SUB TF 1 H 1\n";

/// Sum of the shares' constraints with the nodes at `moved` and the master turned by R.
Eigen::Matrix<double, 6, 1> constraints(const Model& model, const NodeMap& moved, const Mat3& R) {
  Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
  for (const Model::Part& part : model.parts) {
    if (part.type != "MEAN_LINK") continue;
    std::vector<NodeState> nodes;
    for (const int id : part.element->node_ids()) {
      nodes.emplace_back();
      nodes.back().x = moved.at(id);
      if (id == 1) nodes.back().R = R;
    }
    const std::vector<double> multipliers(6, 0.0);
    State state;
    state.nodes = nodes;
    state.multipliers = multipliers;
    std::array<double, 6> phi{}, rate{}, second{};
    part.element->constraint_rates(state, phi, rate, second);
    for (std::size_t m = 0; m < 6; ++m) sum[static_cast<Eigen::Index>(m)] += phi[m];
  }
  return sum;
}

TEST(MeanLink, ARigidMotionOfAllClosesIt) {
  const DeckModel deck(deck_of_places);
  const Mat3 R = rotation_exp(Vec3(0.7, -1.9, 0.4));
  NodeMap moved;
  for (const auto& [id, x] : linked_nodes) moved[id] = R * x + Vec3(3, -2, 5);
  EXPECT_LT(constraints(deck.model, moved, R).norm(), 1e-14);
}

TEST(MeanLink, MeasuresMeanDisplacementAndRotation) {
  // the master stays: the group turned by a small angle about its mean place is a mean rotation by that angle, displaced a mean
  // displacement
  const DeckModel deck(deck_of_places);
  const Vec3 turn(1e-6, -2e-6, 3e-6), shift(0.3, -0.1, 0.2);
  const Vec3 centre = (linked_nodes.at(2) + 2 * linked_nodes.at(3) + 0.5 * linked_nodes.at(4)) / 3.5;
  NodeMap moved = linked_nodes;
  for (const int id : {2, 3, 4}) moved[id] = linked_nodes.at(id) + shift + turn.cross(linked_nodes.at(id) - centre);
  const auto phi = constraints(deck.model, moved, Mat3::Identity());
  EXPECT_LT((phi.head<3>() - shift).norm(), 1e-15);
  EXPECT_LT((phi.tail<3>() - turn).norm(), 1e-9 * turn.norm());
}

TEST(MeanLink, WeightsMayBeNegativeOrZero) {
  // the consistent weights of faces of second order, over (0, 2) x (0, 2) and half of it: corners, then the nodes between
  const std::string face = "0 0  2 0  2 2  0 2  1 0  2 1  1 2  0 1", half = "0 0  2 0  0 2  1 0  1 1  0 1";
  for (const auto& [places, weights, centre] :
       {std::tuple(face, "-1 -1 -1 -1 4 4 4 4", Vec3(1, 1, 0)), std::tuple(half, "0 0 0 1 1 1", Vec3(2.0 / 3, 2.0 / 3, 0))}) {
    std::string nodes = ".NOE\n I 1 X 0 Y 0 Z 1\n", members;
    NodeMap moved{{1, Vec3(0, 0, 1)}};
    const Vec3 turn(1e-6, -2e-6, 3e-6), shift(0.3, -0.1, 0.2);
    std::istringstream stream(places);
    double x = 0, y = 0;
    for (int id = 2; stream >> x >> y; ++id) {
      nodes += " I " + std::to_string(id) + " X " + std::to_string(x) + " Y " + std::to_string(y) + "\n";
      members += " " + std::to_string(id);
      moved[id] = Vec3(x, y, 0) + shift + turn.cross(Vec3(x, y, 0) - centre);
    }
    const DeckModel deck(nodes + ".MCE\n I 7 MEAN_LINK N 1 MEMBERS" + members + " W " + weights +
                         "\n I 8 SPHERICAL N 0 1 AT 0 0 1\n.SAM TYPE STATIC\n.SUB TF 1 H 1\n");
    const auto phi = constraints(deck.model, moved, Mat3::Identity());
    EXPECT_LT((phi.head<3>() - shift).norm(), 1e-14) << weights;
    EXPECT_LT((phi.tail<3>() - turn).norm(), 1e-8 * turn.norm()) << weights;
  }
}

TEST(MeanLink, RotationIsThatOfTheBestFit) {
  // Φ_r = 0 is the condition of the least Σ w |R e - (x - x̄)|², as found by the polar decomposition of Σ w (x - x̄) eᵀ
  const DeckModel deck(deck_of_places);
  const std::array<double, 3> w = {1, 2, 0.5};
  NodeMap moved = linked_nodes;
  moved[2] += Vec3(0.3, 0.1, -0.2);
  moved[3] += Vec3(-0.1, 0.25, 0.1);
  moved[4] += Vec3(0.2, -0.15, 0.3);
  Vec3 centre = Vec3::Zero(), now = Vec3::Zero();
  for (int i = 0; i < 3; ++i) {
    centre += w[static_cast<std::size_t>(i)] / 3.5 * linked_nodes.at(2 + i);
    now += w[static_cast<std::size_t>(i)] / 3.5 * moved.at(2 + i);
  }
  Mat3 F = Mat3::Zero();
  for (int i = 0; i < 3; ++i)
    F += w[static_cast<std::size_t>(i)] * (moved.at(2 + i) - now) * (linked_nodes.at(2 + i) - centre).transpose();
  const Eigen::JacobiSVD<Mat3> svd(F, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Mat3 sign = Mat3::Identity();
  sign(2, 2) = (svd.matrixU() * svd.matrixV().transpose()).determinant();
  const Mat3 R = svd.matrixU() * sign * svd.matrixV().transpose();
  moved[1] = now + R * (linked_nodes.at(1) - centre);
  EXPECT_LT(constraints(deck.model, moved, R).norm(), 1e-14);
}

TEST(MeanLink, OnlyTheFirstShareBringsMultipliers) {
  const DeckModel deck(deck_of_places);
  std::size_t own = 0, shares = 0;
  for (const Model::Part& part : deck.model.parts) {
    if (part.type != "MEAN_LINK") continue;
    own += part.element->layout().own_multipliers();
    ++shares;
  }
  EXPECT_EQ(own, 6u);
  EXPECT_EQ(shares, 3u);
}

}  // namespace
}  // namespace engrane::elements::structural
