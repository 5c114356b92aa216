// SPDX-License-Identifier: BSD-3-Clause
#include "elements/springs/torsion_spring.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "elements/suite.hpp"
#include "math/rotation.hpp"

namespace engrane::elements::springs {
namespace {

using namespace suite;

const Vec3 axis(0.3, -0.5, 0.7);

Subject subject(std::array<int, 2> ends, double stiffness, double damping) {
  Subject s;
  s.name = "K " + std::to_string(stiffness) + " C " + std::to_string(damping);
  s.nodes = {{0, Vec3::Zero()}, {1, {1, 0.2, -0.3}}, {2, {-0.5, 0.4, 0.8}}};
  s.build = [=](const Mat3& Q) {
    TorsionSpringData data;
    data.nodes = ends;
    const Vec3 turned_axis = Q * axis;
    data.axis = {turned_axis[0], turned_axis[1], turned_axis[2]};
    data.stiffness = stiffness;
    data.damping = damping;
    return build(torsion_spring_type(), data, turned(s.nodes, Q));
  };
  return s;
}

TEST(TorsionSpring, Suite) {
  Subject s = subject({1, 2}, 12, 0);
  s.build_swapped = [] {
    TorsionSpringData data;
    data.nodes = {2, 1};
    data.axis = {0.3, -0.5, 0.7};
    data.stiffness = 12;
    return build(torsion_spring_type(), data, {{1, {1, 0.2, -0.3}}, {2, {-0.5, 0.4, 0.8}}});
  };
  run_suite(s);
  run_suite(subject({0, 2}, 12, 0));
  s = subject({1, 2}, 12, 3);
  s.skip[Check::lagrange] = "a damper has no potential";
  run_suite(s);
}

TEST(TorsionSpring, SuiteOfLaws) {
  FunctionMap functions;
  functions[1] = std::make_unique<Wave>(0.3, 0.7, 1.9, 0.4);
  for (const auto& [law, damping_law] :
       {std::pair<deck::Tagged, int>{{"POLY", {40, -7, 90}}, 0}, {{"TABLE", {1}}, 0}, {{"POLY", {5, 0, 1}}, 1}}) {
    Subject s = subject({1, 2}, 0, 0);
    s.name = "LAW " + law.tag + " CLAW " + std::to_string(damping_law);
    s.build = [&, nodes = s.nodes, law = law, damping_law = damping_law](const Mat3& Q) {
      TorsionSpringData data;
      data.nodes = {1, 2};
      const Vec3 turned_axis = Q * axis;
      data.axis = {turned_axis[0], turned_axis[1], turned_axis[2]};
      data.law = law;
      data.damping_law = damping_law;
      return build(torsion_spring_type(), data, turned(nodes, Q), {.functions = &functions});
    };
    if (damping_law != 0) s.skip[Check::lagrange] = "a damper has no potential";
    if (law.is("TABLE") || damping_law != 0)
      for (const Check check : {Check::rigid, Check::zero}) s.skip[check] = "the function is not zero at zero";
    run_suite(s);
  }
}

TEST(TorsionSpring, Extremes) {
  for (const double stiffness : {1e-6, 1e15}) run_extreme(subject({1, 2}, stiffness, stiffness));
}

TEST(TorsionSpring, WindsUpThroughManyTurns) {
  TorsionSpringData data;
  data.nodes = {0, 1};
  data.axis = {0, 0, 2};
  data.stiffness = 10;
  data.angle0 = 90;
  const NodeMap nodes = {{0, Vec3::Zero()}, {1, {1, 2, 3}}};
  const auto spring = build(torsion_spring_type(), data, nodes);
  StateBuffer state(*spring, nodes);
  const double relaxed = std::numbers::pi / 2;
  for (int i = 0; i <= 200; ++i) {
    const double angle = -0.37 * i;
    state.turn(1, rotation_exp({0, 0, angle}), Vec3::Zero());
    EXPECT_NEAR(channel_of(*spring, state, "ANGLE"), angle, 1e-12);
    EXPECT_NEAR(channel_of(*spring, state, "TORQUE"), -10 * (angle - relaxed), 1e-11);
    EXPECT_NEAR(spring->energies(state.view()).potential, 5 * (angle - relaxed) * (angle - relaxed), 1e-9);
    state.commit(*spring);
  }
}

TEST(TorsionSpring, NeedsAStiffness) {
  TorsionSpringData data;
  data.nodes = {0, 1};
  data.axis = {0, 0, 1};
  Diagnostics diagnostics;
  EXPECT_EQ(build(torsion_spring_type(), data, {{0, Vec3::Zero()}, {1, Vec3::Zero()}}, {.diagnostics = &diagnostics}), nullptr);
  EXPECT_EQ(diagnostics.errors(), 1);
}

}  // namespace
}  // namespace engrane::elements::springs
