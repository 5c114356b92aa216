// SPDX-License-Identifier: BSD-3-Clause
#include "elements/cables/bar.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "elements/suite.hpp"

namespace engrane::elements::cables {
namespace {

using namespace suite;

const NodeMap places = {{0, Vec3::Zero()}, {1, {1, 0.2, -0.3}}, {2, {-0.5, 0.4, 0.8}}};

Subject subject(const std::string& name, std::array<int, 2> ends, const std::function<void(BarData&)>& fill = {}) {
  Subject s;
  s.name = name;
  s.nodes = places;
  s.length = 0.3;
  s.build = [=](const Mat3& Q) {
    BarData data;
    data.nodes = ends;
    data.stiffness = 40;
    if (fill) fill(data);
    return build(bar_type(), data, turned(places, Q));
  };
  return s;
}

TEST(Bar, Suite) {
  run_suite(subject("plain", {1, 2}));
  run_suite(subject("on the ground", {2, 0}));
  Subject s = subject("heavy", {1, 2}, [](BarData& d) { d.mass = 3; });
  s.mass = 3 * (places.at(1) - places.at(2)).norm();
  s.skip[Check::equilibrium] = "it has weight";
  run_suite(s);
  run_suite(subject("logarithmic", {1, 2}, [](BarData& d) { d.logarithmic = true; }));
  s = subject("with tension", {1, 2}, [](BarData& d) { d.tension = 7; });
  s.skip[Check::zero] = s.skip[Check::rigid] = "it is stretched in the reference configuration";
  run_suite(s);
  s = subject("damped, of another length", {1, 2}, [](BarData& d) {
    d.damping = 0.2;
    d.length = 1.3;
    d.logarithmic = true;
  });
  s.skip[Check::zero] = s.skip[Check::rigid] = "it is stretched in the reference configuration";
  s.skip[Check::lagrange] = "a damper has no potential";
  run_suite(s);
  s = subject("slack, damped", {1, 2}, [](BarData& d) {
    d.damping = 0.2;
    d.width = 0.1;
  });
  s.skip[Check::zero] = s.skip[Check::rigid] = "half of the width's force is left without strain";
  s.skip[Check::lagrange] = "a damper has no potential";
  run_suite(s);
  s = subject("slack", {1, 2}, [](BarData& d) { d.width = 0.1; });
  s.skip[Check::zero] = s.skip[Check::rigid] = "half of the width's force is left without strain";
  run_suite(s);
}

TEST(Bar, Extremes) {
  for (const double width : {1e-12, 1e3}) run_extreme(subject("width", {1, 2}, [=](BarData& d) { d.width = width; }));
}

/// Tension at a length l along x of a bar that is 2 long.
double tension(double l, const std::function<void(BarData&)>& fill = {}) {
  const NodeMap nodes = {{1, Vec3::Zero()}, {2, {2, 0, 0}}};
  BarData data;
  data.nodes = {1, 2};
  data.stiffness = 40;
  if (fill) fill(data);
  const auto bar = build(bar_type(), data, nodes);
  StateBuffer state(*bar, nodes);
  state.nodes[1].x = {l, 0, 0};
  return channel_of(*bar, state, "FORCE");
}

TEST(Bar, Laws) {
  EXPECT_NEAR(tension(3), 40 * (9.0 - 4) / 8 * 1.5, 1e-13) << "EA (l2 - L2)/2L2 l/L";
  EXPECT_NEAR(tension(3, [](BarData& d) { d.logarithmic = true; }), 40 * std::log(1.5) / 1.5, 1e-13);
  EXPECT_NEAR(tension(2, [](BarData& d) { d.tension = 7; }), 7, 1e-14);
  EXPECT_NEAR(tension(2, [](BarData& d) { d.length = 1.6; }), 40 * (4 - 2.56) / 5.12 * 2 / 1.6, 1e-13);
  const auto slack = [](BarData& d) { d.width = 1e-4; };
  EXPECT_NEAR(tension(2, slack), 40 * 1e-4 / 2, 1e-16);
  EXPECT_NEAR(tension(2.1, slack) / tension(2.1), 1, 1e-6) << "taut: a part w2/4e2 more";
  EXPECT_NEAR(tension(1.9, slack) / (40 * 1e-8 / 4 / 0.04875 * 0.95), 1, 2e-6) << "slack: EA w2/4|e| l/L is left";
}

TEST(Bar, FaultsOfTheCard) {
  const NodeMap nodes = {{1, {1, 2, 3}}, {2, {1, 2, 3}}, {3, {1, 2, 4}}};
  const auto message = [&](const BarData& data) {
    Diagnostics diagnostics;
    EXPECT_EQ(build(bar_type(), data, nodes, {.diagnostics = &diagnostics}), nullptr);
    return diagnostics.all().empty() ? std::string() : diagnostics.all().front().message;
  };
  BarData data;
  data.stiffness = 1;
  data.nodes = {1, 2};
  EXPECT_EQ(message(data), "both ends of the bar are in one place");
  data.nodes = {1, 3};
  data.length = data.tension = 1;
  EXPECT_EQ(message(data), "TENSION beside LENGTH");
}

}  // namespace
}  // namespace engrane::elements::cables
