// SPDX-License-Identifier: BSD-3-Clause
#include "elements/control/sensor.hpp"

#include "elements/control/coordinate_cases.hpp"

namespace engrane::elements::control {
namespace {

using namespace suite;

const NodeMap places = {{0, Vec3::Zero()}, {1, {1, 0.2, -0.3}}, {2, {-0.5, 0.4, 0.8}}};

SensorData sensor(std::vector<int> nodes, const char* kind) {
  SensorData data;
  data.nodes = std::move(nodes);
  data.kind.tag = kind;
  if (!data.kind.is("DISTANCE")) data.axis = {{0.3, -0.5, 0.7}};
  return data;
}

TEST(Sensor, SuiteHasNoForces) {
  for (const char* kind : {"DISTANCE", "ANGLE", "DISPLACEMENT"})
    for (const std::vector<int>& nodes : {std::vector{1, 2}, {0, 2}, {2}}) {
      Subject s;
      s.name = kind;
      s.nodes = places;
      s.build = [=](const Mat3& Q) { return build(sensor_type(), sensor(nodes, kind), turned(places, Q)); };
      run_suite(s);
      run_extreme(s);
      const auto element = s.build(Mat3::Identity());
      EXPECT_TRUE(element->layout().scalars.empty() && element->layout().multipliers.empty());
      for (const NodeNeed need : element->layout().needs) EXPECT_EQ(need, NodeNeed{}) << "it asks for no unknowns";
    }
}

/// Every channel's rate is the derivative of its value along any motion.
TEST(Sensor, SpeedIsTheRate) {
  Random random(3);
  for (const char* kind : {"DISTANCE", "ANGLE", "DISPLACEMENT"}) {
    Subject s;
    s.nodes = places;
    const auto element = build(sensor_type(), sensor({1, 2}, kind), places);
    for (int i = 0; i < 10; ++i) {
      const StateBuffer state = random_state(s, *element, random);
      const double h = 1e-3;
      const auto value = [&](double t) { return channel_of(*element, state.after(t), kind); };
      const double rate = (8 * (value(h) - value(-h)) - (value(2 * h) - value(-2 * h))) / (12 * h);
      EXPECT_NEAR(channel_of(*element, state, "SPEED"), rate, 1e-6 * (1 + std::abs(rate))) << kind;
    }
  }
}

TEST(Sensor, KnownValues) {
  StateBuffer state(*build(sensor_type(), sensor({1, 2}, "DISTANCE"), places), places);
  const auto distance = build(sensor_type(), sensor({1, 2}, "DISTANCE"), places);
  state.nodes[0].x = {1, 1, 1};
  state.nodes[1].x = {4, 5, 1};
  state.nodes[1].v = {3, 4, 12};
  EXPECT_NEAR(channel_of(*distance, state, "DISTANCE"), 5, 1e-15);
  EXPECT_NEAR(channel_of(*distance, state, "SPEED"), 5, 1e-14);
  EXPECT_NEAR(channel_of(*distance, state, "RELATIVE_SPEED"), 13, 1e-14);

  SensorData along = sensor({2}, "DISPLACEMENT");
  along.axis = {{0, 0, 2}};
  const auto displacement = build(sensor_type(), along, places);
  StateBuffer moved(*displacement, places);
  EXPECT_NEAR(channel_of(*displacement, moved, "DISPLACEMENT"), 0, 1e-15);
  moved.nodes[1].x += Vec3(7, 8, 9);
  EXPECT_NEAR(channel_of(*displacement, moved, "DISPLACEMENT"), 9, 1e-14);
}

TEST(Sensor, CountsTurnsOfEitherNode) {
  SensorData data = sensor({1, 2}, "ANGLE");
  data.axis = {{0, 0, 1}};
  const auto element = build(sensor_type(), data, places);
  StateBuffer state(*element, places);
  for (int third = 1; third <= 300000; ++third) {
    state.turn(0, rotation_exp(Vec3(0, 0, -2 * std::numbers::pi * (third % 3) / 3)), Vec3::Zero());
    state.commit(*element);
  }
  EXPECT_NEAR(channel_of(*element, state, "ANGLE") / (2 * std::numbers::pi), 100000, 1e-10);
}

TEST(Sensor, FaultsOfTheCard) {
  const auto message = [&](const SensorData& data) {
    Diagnostics diagnostics;
    EXPECT_EQ(build(sensor_type(), data, places, {.diagnostics = &diagnostics}), nullptr);
    return diagnostics.all().empty() ? std::string() : diagnostics.all().front().message;
  };
  SensorData data = sensor({1, 2}, "ANGLE");
  data.axis.reset();
  EXPECT_EQ(message(data), "ANGLE needs an axis");
  data = sensor({1, 2}, "DISTANCE");
  data.axis = {{1, 0, 0}};
  EXPECT_EQ(message(data), "a distance has no axis");
  data = sensor({1, 2}, "DISTANCE");
  data.at = {{1, 0, 0}};
  EXPECT_EQ(message(data), "AT is where the ground's end is, and neither node is the ground");
  data = sensor({0, 1}, "DISTANCE");
  data.at = {{1, 0.2, -0.3}};
  EXPECT_EQ(message(data), "nodes 0 and 1 are in one place: there is no line between them");
}

}  // namespace
}  // namespace engrane::elements::control
