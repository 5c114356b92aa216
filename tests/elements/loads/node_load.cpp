// SPDX-License-Identifier: BSD-3-Clause
#include "model/node_load.hpp"

#include <gtest/gtest.h>

#include "elements/suite.hpp"

namespace engrane::elements::loads {
namespace {

using namespace suite;

const Wave wave(0.3, 0.7, 1.9, 0.4);

TEST(NodeLoad, Suite) {
  const Vec3 none = Vec3::Zero(), some(3, -2, 1), other(0.5, 2, -1);
  for (const auto& load : {std::pair(some, none), {none, other}, {some, other}}) {
    const Vec3 force = load.first, moment = load.second;
    Subject s;
    s.name = "force " + std::to_string(force.norm()) + ", moment " + std::to_string(moment.norm());
    s.nodes = {{4, {1, 2, 3}}};
    s.build = [=](const Mat3& Q) { return make_node_load(1, 4, Vec3::Zero(), Q * force, Q * moment, &wave); };
    s.skip[Check::lagrange] = "an applied load has no potential";
    s.skip[Check::zero] = s.skip[Check::rigid] = "a load acts at rest";
    s.skip[Check::objectivity] = "it is fixed in space";
    s.skip[Check::equilibrium] = "it comes from outside the model";
    run_suite(s);
  }
}

/// Only what the card gives has histories: global components, with the factor of the function.
TEST(NodeLoad, Channels) {
  const Vec3 none = Vec3::Zero(), some(3, 0, 1), other(0.5, 2, -1);
  const auto check = [](const Vec3& force, const Vec3& moment, const Function* function) {
    const auto load = make_node_load(1, 4, Vec3::Zero(), force, moment, function);
    StateBuffer state(*load, {{4, {1, 2, 3}}});
    state.time = 0.6;
    const double factor = function ? function->at(state.time).f : 1;
    std::size_t count = 0;
    const auto three = [&](const std::string& name, const Vec3& given, const Dimension& dimension) {
      if (given.isZero(0)) return;
      for (const char axis : {'X', 'Y', 'Z'}) {
        const Named& channel = load->channels().at(count++);
        EXPECT_EQ(channel.name, name + "_" + axis);
        EXPECT_EQ(channel.dimension, dimension);
        EXPECT_DOUBLE_EQ(channel_of(*load, state, channel.name), factor * given[axis - 'X']);
      }
    };
    three("FORCE", force, dimension::force);
    three("MOMENT", moment, dimension::moment);
    EXPECT_EQ(load->channels().size(), count);
  };
  for (const Function* function : {static_cast<const Function*>(&wave), static_cast<const Function*>(nullptr)}) {
    check(some, none, function);
    check(none, other, function);
    check(some, other, function);
  }
}

/// One arrow for each of them, as those of FORCE and TORQUE: only a moment says `couple`.
TEST(NodeLoad, Arrows) {
  const Vec3 none = Vec3::Zero(), some(0, -3, 0), other(0, 0, 2);
  const auto arrows = [](const Vec3& force, const Vec3& moment) {
    const auto load = make_node_load(1, 4, Vec3(1, 2, 3), force, moment, nullptr);
    EXPECT_TRUE(load->is_load());
    return load->drawing();
  };
  const std::string push = R"("shape": "arrow", "node": 4, "center": [1, 2, 3], "axis": [0, -1, 0], "holder": 0)",
                    turn = R"("shape": "arrow", "couple": true, "node": 4, "center": [1, 2, 3], "axis": [0, 0, 1], "holder": 0)";
  EXPECT_EQ(arrows(some, none), Drawing{push});
  EXPECT_EQ(arrows(none, other), Drawing{turn});
  EXPECT_EQ(arrows(some, other), (Drawing{push, turn}));
}

}  // namespace
}  // namespace engrane::elements::loads
