// SPDX-License-Identifier: BSD-3-Clause
#include "elements/loads/force.hpp"

#include <gtest/gtest.h>

#include "elements/loads/waves.hpp"
#include "elements/suite.hpp"
#include "math/rotation.hpp"

namespace engrane::elements::loads {
namespace {

using namespace suite;

const NodeMap places = {{0, Vec3::Zero()}, {1, {1, 0.2, -0.3}}, {2, {-0.5, 0.4, 0.8}}};

std::array<double, 3> components(const Vec3& v) { return {v[0], v[1], v[2]}; }

Subject subject(std::string name, const ForceData& wished) {
  Subject s;
  s.name = std::move(name);
  s.nodes = places;
  s.build = [=](const Mat3& Q) {
    ForceData data = wished;
    data.value = -4;
    data.function = 1;
    if (data.direction) data.direction = components(Q * Vec3((*data.direction)[0], (*data.direction)[1], (*data.direction)[2]));
    if (data.at) data.at = components(Q * Vec3((*data.at)[0], (*data.at)[1], (*data.at)[2]));
    return build(force_type(), data, turned(places, Q), {.functions = &functions});
  };
  s.skip[Check::lagrange] = "an applied force has no potential";
  s.skip[Check::zero] = "an applied force acts at rest";
  s.skip[Check::rigid] = "an applied force acts at rest";
  return s;
}

TEST(Force, SuiteBetweenTwoNodes) {
  ForceData data;
  data.nodes = {1, 2};
  Subject s = subject("two nodes", data);
  s.step = 1e-4;  // the line may be short, and turns fast then
  s.tolerance = 1e-7;
  s.build_swapped = [] {
    ForceData swapped;
    swapped.nodes = {2, 1};
    swapped.value = -4;
    swapped.function = 1;
    return build(force_type(), swapped, places, {.functions = &functions});
  };
  run_suite(s);
  data.nodes = {0, 2};
  data.at = {{0.3, -0.6, 0.2}};
  s = subject("from the ground", data);
  s.step = 1e-4;
  s.tolerance = 1e-7;
  run_suite(s);
}

TEST(Force, SuiteOnOneNode) {
  ForceData data;
  data.nodes = {2};
  data.direction = {{0.3, -0.5, 0.7}};
  for (const bool offset : {false, true})
    for (const bool follow : {false, true}) {
      if (offset) data.at = {{0.1, 0.6, -0.4}};
      data.follow = follow;
      Subject s = subject(follow ? "follower" : "fixed", data);
      s.skip[Check::equilibrium] = "the other end of the force is outside the model";
      if (!follow) s.skip[Check::objectivity] = "its direction is fixed in space";
      run_suite(s);
    }
}

TEST(Force, Extremes) {
  ForceData data;
  data.nodes = {1, 2};
  run_extreme(subject("two nodes", data));
  data.nodes = {2};
  data.direction = {{1e-200, 0, 1e-200}};
  data.at = {{1e6, 1e-9, 0}};
  data.follow = true;
  run_extreme(subject("one node", data));
}

TEST(Force, PositivePushesApart) {
  ForceData data;
  data.nodes = {1, 2};
  data.value = 10;
  const NodeMap nodes = {{1, Vec3::Zero()}, {2, {3, 4, 0}}};
  const auto force = build(force_type(), data, nodes);
  const auto r = residual_of(*force, StateBuffer(*force, nodes));
  EXPECT_NEAR(-r[0], -6, 1e-14);
  EXPECT_NEAR(-r[6], 6, 1e-14);
  EXPECT_NEAR(-r[7], 8, 1e-14);
}

TEST(Force, FollowerTurnsWithItsNode) {
  ForceData data;
  data.nodes = {1};
  data.direction = {{0, -1, 0}};
  data.value = 2;
  data.at = {{0.5, 0, 0}};
  const NodeMap nodes = {{1, Vec3::Zero()}};
  const auto applied = [&] {
    const auto force = build(force_type(), data, nodes);
    StateBuffer state(*force, nodes);
    state.turn(0, rotation_exp({0, 0, 1.5707963267948966}), Vec3::Zero());
    return residual_of(*force, state);
  };
  auto r = applied();
  EXPECT_NEAR(-r[1], -2, 1e-15);
  EXPECT_NEAR(-r[5], 0, 1e-15) << "the point is straight above the node";
  data.follow = true;
  r = applied();
  EXPECT_NEAR(-r[0], 2, 1e-15);
  EXPECT_NEAR(-r[5], -1, 1e-15);
}

TEST(Force, FaultsOfTheCard) {
  const NodeMap nodes = {{0, Vec3::Zero()}, {1, {1, 0, 0}}, {2, {1, 0, 0}}};
  const auto message = [&](const ForceData& data) {
    Diagnostics diagnostics;
    EXPECT_EQ(build(force_type(), data, nodes, {.diagnostics = &diagnostics}), nullptr);
    return diagnostics.all().empty() ? std::string() : diagnostics.all().front().message;
  };
  ForceData data;
  data.nodes = {1};
  EXPECT_EQ(message(data), "a force on one node needs a direction");
  data.direction = {{0, 0, 0}};
  EXPECT_EQ(message(data), "DIR 0 0 0 is not a direction");
  data.nodes = {1, 2};
  EXPECT_EQ(message(data), "two nodes and a direction");
  data.direction.reset();
  EXPECT_EQ(message(data), "nodes 1 and 2 are in one place: there is no line between them");
  data.nodes = {0, 1};
  data.follow = true;
  EXPECT_EQ(message(data), "between two nodes the force is along their line");
}

}  // namespace
}  // namespace engrane::elements::loads
