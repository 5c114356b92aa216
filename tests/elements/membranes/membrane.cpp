// SPDX-License-Identifier: BSD-3-Clause
#include "elements/membranes/membrane.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "elements/suite.hpp"

namespace engrane::elements::membranes {
namespace {

using namespace suite;

std::vector<deck::Record> materials() {
  std::vector<deck::Record> records(3);
  deck::MaterialCard card;
  card.young = {50};
  card.poisson = {0.3};
  card.density = 2;
  card.expansion = {0.01};
  records[0].id = 1;
  records[0].data = card;
  card.behaviour = "NEO-HOOKEAN";
  records[1].id = 2;
  records[1].data = card;
  card.behaviour = "ELASTIC";
  card.young = {50, 40, 30};
  card.poisson = {0.3, 0.2, 0.1};
  card.shear = {9, 8, 7};
  records[2].id = 3;
  records[2].data = card;
  return records;
}

/// Corners and middles of a warped and distorted skin in space.
NodeMap skin(int nodes) {
  const std::vector<Vec3> three = {{0.1, 0, 0.2},    {1.2, 0.1, -0.1}, {0.3, 1.1, 0.3},
                                   {0.7, -0.1, 0.1}, {0.8, 0.7, 0.15}, {0.1, 0.6, 0.3}};
  const std::vector<Vec3> four = {{0.1, 0, 0.2},    {1.2, 0.1, -0.1}, {1.3, 1.2, 0.3}, {0, 0.9, 0.2},
                                  {0.6, -0.1, 0.1}, {1.4, 0.6, 0.15}, {0.7, 1.1, 0.3}, {0.1, 0.4, 0.1}};
  NodeMap map;
  for (int i = 0; i < nodes; ++i) map[i + 1] = (nodes % 3 == 0 ? three : four)[static_cast<std::size_t>(i)];
  return map;
}

Subject subject(int nodes, const std::function<void(MembraneData&)>& fill = {}, const Temperatures* temperatures = nullptr) {
  Subject s;
  s.name = std::to_string(nodes) + " nodes";
  s.nodes = skin(nodes);
  s.length = 0.1;
  s.build = [=](const Mat3& Q) {
    static const std::vector<deck::Record> records = materials();
    MembraneData data;
    for (int i = 1; i <= nodes; ++i) data.nodes.push_back(i);
    data.material = 1;
    data.thickness = 0.2;
    if (fill) fill(data);
    return build(membrane_type(), data, turned(skin(nodes), Q), {.records = &records, .temperatures = temperatures});
  };
  s.skip[Check::equilibrium] = "it has weight";
  return s;
}

TEST(Membrane, Suite) {
  for (const int nodes : {3, 6, 4, 8}) {
    run_suite(subject(nodes));
    run_suite(subject(nodes, [](MembraneData& d) { d.material = 2; }));
    Subject s = subject(nodes, [](MembraneData& d) { d.tension = 7; });
    s.skip[Check::zero] = s.skip[Check::rigid] = "it is stretched in the reference configuration";
    run_suite(s);
    for (const int material : {1, 2}) {
      s = subject(nodes, [material](MembraneData& d) {
        d.material = material;
        d.wrinkling = true;
        d.slack = 0.02;
      });
      s.step = 2e-5;  // differences over the moment when a point becomes taut are no derivative
      s.tolerance = 1e-7;
      run_suite(s);
    }
    s = subject(nodes, [](MembraneData& d) { d.pressure = 3; });
    s.skip[Check::zero] = s.skip[Check::rigid] = "it is loaded in the reference configuration";
    s.skip[Check::lagrange] = "a pressure that follows has no potential";
    run_suite(s);
  }
}

/// With temperatures that differ from node to node and change with time.
TEST(Membrane, Warm) {
  static const Wave wave(0.3, 0.7, 1.9, 0.4);
  static const Temperatures temperatures = {{1, {9, &wave}}, {2, {14, &wave}}, {4, {5, nullptr}}, {5, {-3, nullptr}}};
  for (const int nodes : {3, 6, 4, 8})
    for (const int material : {1, 2}) {
      Subject s = subject(
          nodes, [material](MembraneData& d) { d.material = material; }, &temperatures);
      s.name += ", warm";
      s.skip[Check::zero] = s.skip[Check::rigid] = "warmth has forces at rest";
      run_suite(s);
    }
}

/// A state in which every node has moved by the same matrix: the stress is one everywhere, and the forces are its own.
TEST(Membrane, StretchesEvenly) {
  static const std::vector<deck::Record> records = materials();
  const NodeMap nodes = {{1, {0, 0, 0}}, {2, {2, 0, 0}}, {3, {2, 1, 0}}, {4, {0, 1, 0}}};
  MembraneData data;
  data.nodes = {1, 2, 3, 4};
  data.material = 1;
  data.thickness = 0.2;
  const auto membrane = build(membrane_type(), data, nodes, {.records = &records});
  StateBuffer state(*membrane, nodes);
  const double along = 1.3, across = 0.9;
  for (std::size_t i = 0; i < 4; ++i) state.nodes[i].x = {along * state.nodes[i].x[0], 0, across * state.nodes[i].x[1]};
  const double e1 = (along * along - 1) / 2, e2 = (across * across - 1) / 2;
  const double s1 = 50 / 0.91 * (e1 + 0.3 * e2), s2 = 50 / 0.91 * (e2 + 0.3 * e1);
  const auto r = residual_of(*membrane, state);
  EXPECT_NEAR(r[6], s1 * along * 0.2 * 1 / 2, 1e-12) << "S11 times stretch, thickness and width, on two nodes";
  EXPECT_NEAR(r[6 + 1], 0, 1e-13);
  EXPECT_NEAR(r[12 + 2], s2 * across * 0.2 * 2 / 2, 1e-12);
  std::vector<double> fields;
  for (const Field& f : membrane->fields()) fields.resize(fields.size() + f.size(4));
  membrane->evaluate_fields(state.view(), fields);
  const double e3 = -0.3 / 0.7 * (e1 + e2), thin = std::sqrt(1 + 2 * e3);
  EXPECT_NEAR(fields[0], s1 * along / (across * thin), 1e-12) << "true stress: force by the area now";
  EXPECT_NEAR(fields[1], s2 * across / (along * thin), 1e-12);
  EXPECT_NEAR(fields.back(), thin, 1e-14);
}

TEST(Membrane, FaultsOfTheCard) {
  static const std::vector<deck::Record> records = materials();
  const auto message = [&](const MembraneData& data) {
    Diagnostics diagnostics;
    EXPECT_EQ(build(membrane_type(), data, skin(8), {.diagnostics = &diagnostics, .records = &records}), nullptr);
    return diagnostics.all().empty() ? std::string() : diagnostics.all().front().message;
  };
  MembraneData data;
  data.material = 1;
  data.thickness = 1;
  data.nodes = {1, 2, 3, 4, 5};
  EXPECT_EQ(message(data), "a membrane of 5 nodes");
  data.nodes = {1, 2, 4, 3};
  EXPECT_EQ(message(data), "membrane 1 is folded over, or has no area");
  data.nodes = {1, 2, 2};
  EXPECT_EQ(message(data), "node 2 is named twice");
  data.nodes = {1, 2, 3, 4};
  data.material = 3;
  EXPECT_EQ(message(data), "material 3 has no YT and NT of one value, which membranes need");
  data.material = 1;
  data.wrinkling = true;
  data.tension = -1;
  EXPECT_EQ(message(data), "a skin that wrinkles cannot be pressed in its reference configuration");
  data.material = 4;
  EXPECT_EQ(message(data), "material 4 does not exist");
}

}  // namespace
}  // namespace engrane::elements::membranes
