// SPDX-License-Identifier: BSD-3-Clause
#include "elements/beams/line_load.hpp"

#include <gtest/gtest.h>

#include "elements/suite.hpp"
#include "math/rotation.hpp"

namespace engrane::elements::beams {
namespace {

using namespace suite;

FunctionMap waves() {
  FunctionMap functions;
  functions[1] = std::make_unique<Wave>(0.3, 0.7, 1.9, 0.4);
  return functions;
}

const FunctionMap functions = waves();
const NodeMap arc = {{1, {0, 0, 0}}, {2, {0.9, 0.3, -0.2}}, {3, {1.6, 0.9, 0.1}}};

LineLoadData load_on(std::vector<int> nodes, const Vec3& load, bool follow) {
  LineLoadData data;
  data.nodes = std::move(nodes);
  data.load = {load[0], load[1], load[2]};
  data.follow = follow;
  return data;
}

TEST(LineLoad, Suite) {
  for (const std::vector<int>& nodes : {std::vector{1, 2, 3}, std::vector{1, 3}})
    for (const bool follow : {false, true}) {
      Subject s;
      s.name = std::to_string(nodes.size()) + " nodes" + (follow ? ", follower" : "");
      for (const int id : nodes) s.nodes[id] = arc.at(id);
      s.build = [=](const Mat3& Q) {
        LineLoadData data = load_on(nodes, Q * Vec3(3, -1, 2), follow);
        data.function = 1;
        return build(line_load_type(), data, turned(arc, Q), {.functions = &functions});
      };
      s.skip[Check::lagrange] = "an applied force has no potential";
      s.skip[Check::zero] = "an applied force acts at rest";
      s.skip[Check::rigid] = "an applied force acts at rest";
      s.skip[Check::equilibrium] = "it comes from outside";
      if (!follow) s.skip[Check::objectivity] = "its direction is fixed in space";
      run_suite(s);
    }
}

/// On a straight line the nodes of three get 1/6, 4/6 and 1/6, those of two a half; with FOLLOW in directions that turn.
TEST(LineLoad, SharesOfTheNodes) {
  const NodeMap line = {{1, {0, 0, 0}}, {2, {1, 0, 0}}, {3, {2, 0, 0}}};
  const auto forces = [&](const std::vector<int>& nodes, bool follow) {
    NodeMap places;
    for (const int id : nodes) places[id] = line.at(id);
    const auto load = build(line_load_type(), load_on(nodes, {0, 3, 0}, follow), places);
    StateBuffer state(*load, places);
    for (std::size_t i = 0; i < nodes.size(); ++i) state.turn(i, rotation_exp(Vec3(0, 0, 1.5707963267948966)), Vec3::Zero());
    std::vector<double> r(static_cast<std::size_t>(load->layout().slots()));
    EXPECT_TRUE(load->applied(state.view(), r));
    return r;
  };
  const std::vector<double> three = forces({1, 2, 3}, false);
  EXPECT_NEAR(three[1], 1, 1e-15);
  EXPECT_NEAR(three[4], 4, 1e-15);
  EXPECT_NEAR(three[7], 1, 1e-15);
  const std::vector<double> two = forces({1, 3}, false);
  EXPECT_NEAR(two[1], 3, 1e-15);
  EXPECT_NEAR(two[4], 3, 1e-15);
  const std::vector<double> turned = forces({1, 3}, true);
  EXPECT_NEAR(turned[0], -3, 1e-14);
  EXPECT_NEAR(turned[1], 0, 1e-14);
}

}  // namespace
}  // namespace engrane::elements::beams
