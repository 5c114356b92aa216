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
  for (const auto& [force, moment] : {std::pair(some, none), {none, other}, {some, other}}) {
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

}  // namespace
}  // namespace engrane::elements::loads
