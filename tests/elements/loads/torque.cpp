// SPDX-License-Identifier: BSD-3-Clause
#include "elements/loads/torque.hpp"

#include <gtest/gtest.h>

#include "elements/loads/waves.hpp"
#include "elements/suite.hpp"
#include "math/rotation.hpp"

namespace engrane::elements::loads {
namespace {

using namespace suite;

const Vec3 axis(0.3, -0.5, 0.7);

Subject subject(const std::vector<int>& ends, bool follow, bool fixed) {
  Subject s;
  s.name = std::to_string(ends.size()) + " nodes" + (follow ? " FOLLOW" : "") + (fixed ? " FIXED" : "");
  s.nodes = {{0, Vec3::Zero()}, {1, {1, 0.2, -0.3}}, {2, {-0.5, 0.4, 0.8}}};
  s.build = [=](const Mat3& Q) {
    TorqueData data;
    data.nodes = ends;
    const Vec3 turned_axis = Q * axis;
    data.axis = {turned_axis[0], turned_axis[1], turned_axis[2]};
    data.value = -4;
    data.function = 1;
    data.follow = follow;
    data.fixed = fixed;
    return build(torque_type(), data, turned(s.nodes, Q), {.functions = &functions});
  };
  s.skip[Check::lagrange] = "an applied moment has no potential";
  s.skip[Check::zero] = "an applied moment acts at rest";
  s.skip[Check::rigid] = "an applied moment acts at rest";
  if (fixed) s.skip[Check::objectivity] = "its axis is fixed in space";
  return s;
}

TEST(Torque, Suite) {
  run_suite(subject({1, 2}, false, false));
  run_suite(subject({1, 2}, false, true));
  run_suite(subject({2}, false, false));
  run_suite(subject({2}, true, false));
  run_suite(subject({1, 0}, false, false));
}

TEST(Torque, ActsOnTheLastNode) {
  TorqueData data;
  data.nodes = {3, 2};
  data.axis = {0, 0, -1};
  data.value = 1000;
  const NodeMap nodes = {{2, {0, 1, 5}}, {3, {0, 1, 5}}};
  const auto torque = build(torque_type(), data, nodes);
  StateBuffer state(*torque, nodes);
  const auto r = residual_of(*torque, state);  // what the element resists with: minus what it applies
  EXPECT_EQ(-r[5], 1000) << "+V about the axis on the first node would be -1000 about z";
  EXPECT_EQ(-r[11], -1000);
}

TEST(Torque, AxisFollowsTheFirstNodeOrStays) {
  TorqueData data;
  data.nodes = {1, 2};
  data.axis = {0, 0, 1};
  data.value = 3;
  const NodeMap nodes = {{1, Vec3::Zero()}, {2, Vec3::Zero()}};
  const auto applied = [&] {
    const auto torque = build(torque_type(), data, nodes);
    StateBuffer state(*torque, nodes);
    state.turn(0, rotation_exp({1.5707963267948966, 0, 0}), Vec3::Zero());  // z becomes -y
    const auto r = residual_of(*torque, state);
    return Vec3(-r[9], -r[10], -r[11]);
  };
  EXPECT_LT((applied() - Vec3(0, -3, 0)).norm(), 1e-15);
  data.fixed = true;
  EXPECT_LT((applied() - Vec3(0, 0, 3)).norm(), 1e-15);
}

TEST(Torque, Extremes) { run_extreme(subject({1, 2}, false, false)); }

TEST(Torque, FaultsOfTheCard) {
  Diagnostics diagnostics;
  TorqueData data;
  data.nodes = {1};
  data.axis = {0, 0, 1};
  data.follow = data.fixed = true;
  const NodeMap nodes = {{0, Vec3::Zero()}, {1, Vec3::Zero()}};
  EXPECT_EQ(build(torque_type(), data, nodes, {.diagnostics = &diagnostics}), nullptr);
  data.fixed = false;
  data.nodes = {0};
  EXPECT_EQ(build(torque_type(), data, nodes, {.diagnostics = &diagnostics}), nullptr);
  data.nodes = {1};
  data.function = 9;
  EXPECT_EQ(build(torque_type(), data, nodes, {.diagnostics = &diagnostics}), nullptr);
  EXPECT_EQ(diagnostics.errors(), 3);
}

}  // namespace
}  // namespace engrane::elements::loads
