// SPDX-License-Identifier: BSD-3-Clause
#include "elements/springs/spring.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "elements/springs/places.hpp"
#include "elements/suite.hpp"

namespace engrane::elements::springs {
namespace {

using namespace suite;

Subject line(std::array<int, 2> ends, double stiffness, double damping, double size = 1) {
  Subject s;
  s.name = "along the line, K " + std::to_string(stiffness) + " C " + std::to_string(damping);
  for (const auto& [id, x] : places) s.nodes[id] = size * x;
  s.length = s.velocity = size;
  const auto make = [=, nodes = s.nodes](std::array<int, 2> order, const Mat3& Q) {
    SpringData data;
    data.nodes = order;
    data.stiffness = {stiffness};
    data.damping = {damping};
    if (ends[0] == 0) {
      const Vec3 at = size * Q * Vec3(0.3, -0.6, 0.2);
      data.at = {{at[0], at[1], at[2]}};
    }
    return build(spring_type(), data, turned(nodes, Q));
  };
  s.build = [=](const Mat3& Q) { return make(ends, Q); };
  s.build_swapped = [=] { return make({ends[1], ends[0]}, Mat3::Identity()); };
  s.step = 1e-4;  // the line may be short, and turns fast then
  s.tolerance = 1e-7;
  if (damping > 0) s.skip[Check::lagrange] = "a damper has no potential";
  return s;
}

TEST(Spring, SuiteAlongTheLine) {
  run_suite(line({1, 2}, 40, 0));
  run_suite(line({1, 2}, 40, 3));
  run_suite(line({0, 2}, 40, 3));
}

FunctionMap waves() {
  FunctionMap functions;
  functions[1] = std::make_unique<Wave>(0.3, 0.7, 1.9, 0.4);
  functions[2] = std::make_unique<Wave>(-0.1, 1.3, 0.8, 0.2);
  int next = 3;
  for (const char* text : {"40*D + 90*D**3", "40*D*(1 + 0.3*V) + 2*abs(D)*V**3", "40*D*cos(T) + V"}) {
    deck::FunctionCard card;
    card.expression = text;
    deck::Record record;
    record.data = std::move(card);
    Diagnostics diagnostics;
    functions[next++] = make_function(record, diagnostics);
  }
  return functions;
}
const FunctionMap all_waves = waves();

TEST(Spring, SuiteOfLaws) {
  for (const auto& [law, damping_law] : {std::pair<deck::Tagged, int>{{"POLY", {40, -7, 90}}, 0},
                                         {{"POLY", {40}}, 2},
                                         {{"TABLE", {1}}, 0},
                                         {{"TABLE", {1}}, 2},
                                         {{}, 2}}) {
    Subject s;
    s.name = "LAW " + law.tag + " CLAW " + std::to_string(damping_law);
    s.nodes = places;
    const auto make = [law = law, damping_law = damping_law](std::array<int, 2> ends, const Mat3& Q) {
      SpringData data;
      data.nodes = ends;
      data.law = law;
      data.damping_law = damping_law;
      return build(spring_type(), data, turned(places, Q), {.functions = &all_waves});
    };
    s.build = [=](const Mat3& Q) { return make({1, 2}, Q); };
    s.build_swapped = [=] { return make({2, 1}, Mat3::Identity()); };
    s.step = 1e-4;
    s.tolerance = 1e-7;
    if (damping_law != 0) s.skip[Check::lagrange] = "a damper has no potential";
    if (law.is("TABLE") || damping_law != 0)
      for (const Check check : {Check::rigid, Check::zero}) s.skip[check] = "the function is not zero at zero";
    run_suite(s);
  }
}

TEST(Spring, SuiteOfFormulas) {
  for (const int f : {3, 4, 5}) {
    Subject s;
    s.name = "LAW EXPR " + std::to_string(f);
    s.nodes = places;
    const auto make = [f](std::array<int, 2> ends, const Mat3& Q) {
      SpringData data;
      data.nodes = ends;
      data.law = {"EXPR", {static_cast<double>(f)}};
      return build(spring_type(), data, turned(places, Q), {.functions = &all_waves});
    };
    s.build = [=](const Mat3& Q) { return make({1, 2}, Q); };
    s.build_swapped = [=] { return make({2, 1}, Mat3::Identity()); };
    s.step = 1e-4;
    s.tolerance = 1e-7;
    if (f > 3) s.skip[Check::lagrange] = "it depends on the rate or the time";
    run_suite(s);
  }
}

TEST(Spring, LawsOfKnownValues) {
  SpringData data;
  data.nodes = {1, 2};
  data.law = {"POLY", {10, 3, 2}};
  data.length = 3;
  const NodeMap nodes = {{1, Vec3::Zero()}, {2, {3, 4, 0}}};
  auto spring = build(spring_type(), data, nodes);
  EXPECT_NEAR(channel_of(*spring, StateBuffer(*spring, nodes), "FORCE"), 20 + 12 + 16, 1e-13);
  EXPECT_NEAR(channel_of(*spring, StateBuffer(*spring, nodes), "SPRING_ENERGY"), 20 + 8 + 8, 1e-13);
  data.law = {"TABLE", {1}};
  spring = build(spring_type(), data, nodes, {.functions = &all_waves});
  EXPECT_NEAR(channel_of(*spring, StateBuffer(*spring, nodes), "FORCE"), 0.3 + 0.7 * std::sin(1.9 * 2 + 0.4), 1e-14);
}

TEST(Spring, SuiteInGlobalDirections) {
  for (const auto& ends : {std::array<int, 2>{1, 2}, {0, 2}}) {
    Subject s;
    s.name = "global directions";
    s.nodes = places;
    s.build = [=](const Mat3& Q) {
      SpringData data;
      data.nodes = ends;
      data.stiffness = {40, 50, 60};
      return build(spring_type(), data, turned(places, Q));
    };
    s.skip[Check::rigid] = "its directions are fixed in space";
    s.skip[Check::objectivity] = "its directions are fixed in space";
    s.skip[Check::rotated_copy] = "its directions are the global ones";
    s.skip[Check::equilibrium] = "its opposite forces need not be in line, as those of a support";
    run_suite(s);
  }
}

TEST(Spring, Extremes) {
  for (const double stiffness : {1e-6, 1e15})
    for (const double size : {1e-9, 1e6}) run_extreme(line({1, 2}, stiffness, stiffness, size));
}

TEST(Spring, EndsThatMeetMakeNoForce) {
  const Subject s = line({1, 2}, 40, 3);
  const auto spring = s.build(Mat3::Identity());
  StateBuffer state(*spring, s.nodes);
  state.nodes[1].x = state.nodes[0].x;
  state.nodes[1].v = {1, 0, 0};
  for (const double entry : residual_of(*spring, state)) EXPECT_EQ(entry, 0);
  for (const double entry : tangent_of(*spring, state, {1, 1, 0})) EXPECT_EQ(entry, 0);
}

TEST(Spring, NaturalLength) {
  SpringData data;
  data.nodes = {1, 2};
  data.stiffness = {10};
  const NodeMap nodes = {{1, Vec3::Zero()}, {2, {3, 4, 0}}};
  auto spring = build(spring_type(), data, nodes);
  EXPECT_EQ(channel_of(*spring, StateBuffer(*spring, nodes), "FORCE"), 0);
  data.length = 2;
  spring = build(spring_type(), data, nodes);
  EXPECT_NEAR(channel_of(*spring, StateBuffer(*spring, nodes), "FORCE"), 30, 1e-13);
  const auto r = residual_of(*spring, StateBuffer(*spring, nodes));
  EXPECT_NEAR(-r[0], 18, 1e-13) << "in tension the first end is pulled towards the second";
  EXPECT_NEAR(-r[6], -18, 1e-13);
}

TEST(Spring, ABlockOfSpringsIsWhatTheyAreAlone) {
  // those with a law of their own are no members of a block: a linear law makes the same spring
  BlockStore store;
  std::vector<std::unique_ptr<Element>> members, alone, lawful;
  for (int i = 0; i < 12; ++i) {
    SpringData data;
    data.nodes = {i % 3 == 0 ? 0 : 1, 2};
    if (data.nodes[0] == 0 && i % 2 == 0) data.at = {{0.3, -0.6, 0.2 * i}};
    data.stiffness = {40.0 + i};
    data.damping = {3.0 / (1 + i)};
    members.push_back(build(spring_type(), data, places, {.blocks = &store}));
    alone.push_back(build(spring_type(), data, places));
    data.stiffness.clear();
    data.law = {"POLY", {40.0 + i}};
    lawful.push_back(build(spring_type(), data, places));
  }
  const auto* block = dynamic_cast<const BlockMember*>(members[1].get());
  ASSERT_NE(block, nullptr);
  EXPECT_EQ(block->block().size(), 8u) << "springs between nodes share one block, those on the ground others";
  EXPECT_EQ(&block->layout(), &members[4]->layout());

  Random random(5);
  const Subject subject = line({0, 2}, 1, 1);
  for (std::size_t i = 0; i < members.size(); ++i) {
    const StateBuffer state = random_state(subject, *members[i], random);
    const Weights weights{1, 20, 400};
    for (const auto& other : {alone[i].get(), lawful[i].get()}) {
      EXPECT_EQ(residual_of(*members[i], state), residual_of(*other, state));
      EXPECT_EQ(tangent_of(*members[i], state, weights), tangent_of(*other, state, weights));
      EXPECT_EQ(channel_of(*members[i], state, "SPRING_ENERGY"), channel_of(*other, state, "SPRING_ENERGY"));
      EXPECT_EQ(channel_of(*members[i], state, "DAMPER_POWER"), channel_of(*other, state, "DAMPER_POWER"));
      EXPECT_EQ(members[i]->drawing(), other->drawing());
    }
  }
  // several at a time
  std::vector<State> states;
  std::vector<StateBuffer> buffers;
  for (const std::size_t i : {1, 2, 4, 5}) buffers.push_back(random_state(subject, *members[i], random));
  for (const StateBuffer& buffer : buffers) states.push_back(buffer.view());
  std::vector<double> r(4 * 6), k(4 * 36), one_r(6), one_k(36);
  block->block().tangent(0, states, {1, 20, 400}, r, k);
  std::size_t at = 0;
  for (const std::size_t i : {1, 2, 4, 5}) {
    members[i]->tangent(states[at], {1, 20, 400}, one_r, one_k);
    EXPECT_EQ(one_r, std::vector<double>(&r[6 * at], &r[6 * at] + 6));
    EXPECT_EQ(one_k, std::vector<double>(&k[36 * at], &k[36 * at] + 36));
    ++at;
  }
}

TEST(Spring, FaultsOfTheCard) {
  const NodeMap nodes = {{0, Vec3::Zero()}, {1, {1, 0, 0}}, {2, {1, 0, 0}}};
  const auto message = [&](const SpringData& data) {
    Diagnostics diagnostics;
    EXPECT_EQ(build(spring_type(), data, nodes, {.diagnostics = &diagnostics}), nullptr);
    return diagnostics.all().empty() ? std::string() : diagnostics.all().front().message;
  };
  SpringData data;
  data.nodes = {1, 2};
  EXPECT_EQ(message(data), "a spring with neither stiffness nor damping does nothing");
  data.stiffness = {1};
  EXPECT_EQ(message(data), "nodes 1 and 2 are in one place: there is no line between them");
  data.stiffness = {1, 2};
  EXPECT_EQ(message(data), "K has 2 values");
  data.stiffness = {1, 2, 3};
  data.damping = {1};
  EXPECT_EQ(message(data), "one value beside three");
  data.damping = {};
  data.law = {"POLY", {1, 2}};
  EXPECT_EQ(message(data), "a law of the elongation has no meaning for a spring in the global directions");
  data.law = {};
  data.length = 1;
  EXPECT_EQ(message(data), "L0 has no meaning for a spring in the global directions");
  data.length.reset();
  data.stiffness = {1};
  data.at = {{0, 0, 1}};
  EXPECT_EQ(message(data), "AT is where the ground's end is, and neither node is the ground");
}

}  // namespace
}  // namespace engrane::elements::springs
