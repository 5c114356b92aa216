// SPDX-License-Identifier: BSD-3-Clause
#include "elements/joints/linear_relation.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "elements/joints/joint_cases.hpp"
#include "elements/suite.hpp"

namespace engrane::elements::joints {
namespace {

using namespace suite;

const NodeMap places = {{0, Vec3::Zero()}, {1, {1, 0.2, -0.3}}, {2, {-0.5, 0.4, 0.8}}};

LinearRelationData relation(std::vector<int> nodes, std::vector<int> components, std::vector<double> coefficients) {
  LinearRelationData data;
  data.nodes = std::move(nodes);
  data.components = std::move(components);
  data.coefficients = std::move(coefficients);
  return data;
}

Subject subject(const std::string& name, const LinearRelationData& data) {
  Subject s;
  s.name = name;
  s.nodes = places;
  s.build = [=](const Mat3& Q) {
    return build(linear_relation_type(), data, turned(places, Q), {.functions = &joint_functions()});
  };
  s.force = 5;
  s.step = 3e-4;
  s.tolerance = 1e-7;
  for (const Check check : {Check::rigid, Check::objectivity, Check::rotated_copy, Check::equilibrium})
    s.skip[check] = "its components are global ones, and the ground holds the rest";
  return s;
}

TEST(LinearRelation, Suite) {
  run_suite(subject("translations", relation({1, 2, 1}, {1, 3, 2}, {2, -1, 0.5})));
  run_suite(subject("rotations", relation({1, 2}, {6, 4}, {1, 3})));
  LinearRelationData mixed = relation({1, 2, 2}, {5, 2, 1}, {0.3, -1, 2});
  mixed.value = 0.7;
  mixed.function = 1;
  run_suite(driven(subject("a rotation and a translation, driven", mixed)));
}

TEST(LinearRelation, Extremes) {
  for (const double size : {1e-9, 1e6}) run_extreme(subject("extreme", relation({1, 2, 1}, {1, 3, 6}, {size, -1, 0.5})));
}

TEST(LinearRelation, ForcesAreInTheRatioOfTheCoefficients) {
  const auto element = build(linear_relation_type(), relation({1, 2, 2}, {1, 3, 6}, {2, -1, 4}), places);
  StateBuffer state(*element, places);
  state.multipliers[0] = 10;
  const auto r = residual_of(*element, state);
  EXPECT_NEAR(-r[0], 20, 1e-14);
  EXPECT_NEAR(-r[6 + 2], -10, 1e-14);
  EXPECT_NEAR(-r[6 + 5], 40, 1e-14);
  state.nodes[0].x += Vec3(0.3, 5, 5);
  state.nodes[1].x += Vec3(5, 5, 0.1);
  EXPECT_NEAR(channel_of(*element, state, "VALUE"), 0.5, 1e-14);
}

TEST(LinearRelation, CountsTurns) {
  const auto element = build(linear_relation_type(), relation({1, 2}, {6, 6}, {1, 2}), places);
  StateBuffer state(*element, places);
  for (int k = 0; k <= 9000; ++k) {
    state.turn(0, rotation_exp(Vec3(0, 0, 2.2 * k)), Vec3::Zero());
    state.turn(1, rotation_exp(Vec3(0, 0, -1.1 * k)), Vec3::Zero());
    state.commit(*element);
  }
  EXPECT_NEAR(channel_of(*element, state, "VALUE"), 0, 1e-10) << "after 3000 turns";
}

TEST(LinearRelation, FaultsOfTheCard) {
  const auto message = [&](const LinearRelationData& data) {
    Diagnostics diagnostics;
    EXPECT_EQ(build(linear_relation_type(), data, places, {.diagnostics = &diagnostics}), nullptr);
    return diagnostics.all().empty() ? std::string() : diagnostics.all().front().message;
  };
  EXPECT_EQ(message(relation({1, 2}, {1}, {1, 1})), "NOEUD names 2 terms, C gives 1");
  EXPECT_EQ(message(relation({1, 2}, {1, 1}, {1, 0})), "the coefficient of node 2 is 0");
  EXPECT_EQ(message(relation({1, 1}, {1, 1}, {1, 2})), "component 1 of node 1 is named twice");
}

}  // namespace
}  // namespace engrane::elements::joints
