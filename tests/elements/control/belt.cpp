// SPDX-License-Identifier: BSD-3-Clause
#include "elements/control/belt.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "elements/joints/joint_cases.hpp"
#include "elements/suite.hpp"

namespace engrane::elements::control {
namespace {

using namespace suite;

BeltData belt(bool crossed, double size = 1) {
  BeltData data;
  data.nodes = {1, 2};
  data.axis = {0.3, -0.5, 0.7};
  data.radii = {0.2 * size, 0.35 * size};
  data.crossed = crossed;
  return data;
}

/// Pulleys in a plane across the axis; random states keep them far enough apart and little tilted.
Subject subject(const std::string& name, const BeltData& wished, double size = 1) {
  Subject s;
  s.name = name;
  const Vec3 axis = Vec3(0.3, -0.5, 0.7).normalized(), across = perpendicular(axis);
  s.nodes = {{0, Vec3::Zero()}, {1, size * Vec3(0.1, 0.4, -0.2)}, {2, size * (Vec3(0.1, 0.4, -0.2) + 1.5 * across)}};
  s.build = [=](const Mat3& Q) {
    BeltData data = wished;
    data.axis = components(Q * Vec3(data.axis.data()));
    return build(belt_type(), data, turned(s.nodes, Q));
  };
  s.adjust = [=](StateBuffer& state, Random& random) {
    const Mat3 Q = uniform_rotation(random);
    for (std::size_t i = 0; i < 2; ++i) {
      const Vec3 place = i == 0 ? Vec3::Zero() : Vec3(size * (Q * (1.5 * across) + 0.2 * uniform_vector(random)));
      state.nodes[i].x = place;
      const double angle = 1.5 * uniform(random);
      state.turn(i, Mat3(rotation_exp(Vec3(0.2 * uniform_vector(random))) * Q * rotation_exp(Vec3(axis * angle))), Vec3::Zero());
    }
  };
  s.length = s.velocity = size;
  s.force = 5;
  s.step = 3e-4;
  s.tolerance = 1e-7;
  if (wished.preload > 0) {
    s.skip[Check::zero] = "it is tight in the reference configuration";
    s.skip[Check::rigid] = "it is tight in the reference configuration";
  }
  return s;
}

TEST(Belt, SuiteRigid) {
  for (const bool crossed : {false, true}) {
    BeltData data = belt(crossed);
    run_suite(subject("rigid", data));
    data.preload = 7;
    run_suite(subject("rigid, tight", data));
  }
}

TEST(Belt, SuiteElastic) {
  for (const bool crossed : {false, true}) {
    BeltData data = belt(crossed);
    data.stiffness = 40;
    data.preload = 90;  // no span goes slack where differences are taken
    run_suite(subject("elastic", data));
    data.damping = 1;
    run_suite(damped(subject("damped", data)));
  }
}

TEST(Belt, Extremes) {
  for (const double stiffness : {1e-6, 1e15})
    for (const double size : {1e-9, 1e6}) {
      BeltData data = belt(false, size);
      data.stiffness = data.preload = data.damping = stiffness;
      Subject s = subject("extreme", data, size);
      s.adjust = [size](StateBuffer& state, Random& random) {
        state.nodes[1].x = state.nodes[0].x + 3 * size * uniform_vector(random).normalized();
      };
      const auto element = s.build(Mat3::Identity());
      Random random(5);
      StateBuffer state = random_state(s, *element, random);
      for (double entry : residual_of(*element, state)) EXPECT_TRUE(std::isfinite(entry));
    }
}

BeltData elastic(double preload = 0, std::optional<double> friction = {}) {
  BeltData data;
  data.stiffness = 1000;
  data.preload = preload;
  data.friction = friction;
  return data;
}

BeltData rigid(double preload) {
  BeltData data;
  data.preload = preload;
  return data;
}

/// Pulleys of 0.2 and 0.4 at a distance of 1 in the plane x, y.
struct Plane {
  explicit Plane(BeltData data) : element(make(std::move(data))), state(*element, nodes()) {}
  static NodeMap nodes() { return {{0, Vec3::Zero()}, {1, Vec3::Zero()}, {2, {1, 0, 0}}}; }
  static std::unique_ptr<Element> make(BeltData data) {
    data.nodes = {1, 2};
    data.axis = {0, 0, 1};
    data.radii = {0.2, 0.4};
    return build(belt_type(), data, nodes());
  }
  double channel(const std::string& name) const { return channel_of(*element, state, name); }
  void commit(double time) {
    state.time = time;
    state.commit(*element);
  }
  void put(double angle_1, double angle_2, double distance = 1) {
    state.turn(0, rotation_exp(Vec3(0, 0, angle_1)), Vec3::Zero());
    state.turn(1, rotation_exp(Vec3(0, 0, angle_2)), Vec3::Zero());
    state.nodes[1].x[0] = distance;
  }

  std::unique_ptr<Element> element;
  StateBuffer state;
};

TEST(Belt, TensionsOfTurnedPulleys) {
  for (const bool crossed : {false, true}) {
    BeltData data = elastic(100);
    data.crossed = crossed;
    Plane plane(data);
    const double side = crossed ? -1 : 1;
    plane.put(0.3, 0.1);
    const double pull = 1000 * (0.2 * 0.3 - side * 0.4 * 0.1);
    EXPECT_NEAR(plane.channel("TENSION_1"), 100 + pull, 1e-11);
    EXPECT_NEAR(plane.channel("TENSION_2"), 100 - pull, 1e-11);
    EXPECT_NEAR(plane.channel("TORQUE_1"), -0.2 * 2 * pull, 1e-11);
    EXPECT_NEAR(plane.channel("TORQUE_2"), side * 0.4 * 2 * pull, 1e-11);
    const auto r = residual_of(*plane.element, plane.state);
    EXPECT_NEAR(-r[5], plane.channel("TORQUE_1"), 1e-11) << "the channel is what the pulley feels";
    EXPECT_NEAR(-r[11], plane.channel("TORQUE_2"), 1e-11);
    // the spans are the common tangents: their directions from the geometry of two circles
    const double sine = (0.2 - side * 0.4), cosine = std::sqrt(1 - sine * sine);
    EXPECT_NEAR(plane.channel("FORCE_X"), -200 * cosine, 1e-11);
    EXPECT_NEAR(plane.channel("FORCE_Y"), 2 * pull * sine, 1e-11);
    EXPECT_NEAR(plane.channel("SPAN"), cosine, 1e-14);
    EXPECT_NEAR(plane.channel("WRAP_1"), std::numbers::pi + 2 * std::asin(sine), 1e-14);
    EXPECT_NEAR(plane.channel("WRAP_2"), std::numbers::pi - side * 2 * std::asin(sine), 1e-14);
  }
}

/// The belt's length L(d) = 2 sqrt(d² − (R − r)²) + π (R + r) + 2 (R − r) asin((R − r)/d) (Shigley) stretches both spans by half
/// its change.
TEST(Belt, CentreDistanceStretchesTheBelt) {
  Plane plane(elastic());
  const auto length = [](double d) {
    return 2 * std::sqrt(d * d - 0.04) + std::numbers::pi * 0.6 + 2 * 0.2 * std::asin(0.2 / d);
  };
  plane.put(0, 0, 1.05);
  EXPECT_NEAR(plane.channel("STRETCH_1"), (length(1.05) - length(1)) / 2, 1e-14);
  EXPECT_NEAR(plane.channel("STRETCH_2"), (length(1.05) - length(1)) / 2, 1e-14);
  plane.put(0, 0, 0.95);
  EXPECT_EQ(plane.channel("TENSION_1"), 0) << "slack";
  EXPECT_EQ(plane.channel("BEARING_FORCE"), 0);
  EXPECT_NEAR(derived_of(*plane.element, "belt length"), length(1), 1e-14);
  EXPECT_NEAR(derived_of(*plane.element, "ratio of speeds"), 0.5, 1e-15);
}

TEST(Belt, SlackSpanDoesNotPushAndItsDamperLetsGo) {
  BeltData data = elastic(10);
  data.damping = 50;
  Plane plane(data);
  plane.put(0.3, 0);
  plane.state.nodes[0].W = {0, 0, 2};
  EXPECT_NEAR(plane.channel("TENSION_1"), 70 * (1 + 5 * 0.4), 1e-11);
  EXPECT_EQ(plane.channel("TENSION_2"), 0);
  plane.state.nodes[0].W = {0, 0, -20};
  EXPECT_EQ(plane.channel("TENSION_1"), 0) << "no push from the damper either";
}

/// Pull p at which the belt of Plane slips: (preload + p)/(preload − p) = exp(μ wrap) of the smaller pulley (Eytelwein).
double most_pull(double preload, double friction) {
  const double wrap = std::numbers::pi + 2 * std::asin(-0.2), ratio = std::exp(friction * wrap);
  return preload * (ratio - 1) / (ratio + 1);
}

TEST(Belt, GripByEytelwein) {
  Plane plane(elastic(100, 0.3));
  plane.put(most_pull(100, 0.3) / 1000 / 0.2, 0);
  EXPECT_NEAR(plane.channel("GRIP_USED"), 1, 1e-12);
}

TEST(Belt, RemarksOnMoreThanFrictionHolds) {
  Plane plane(elastic(100, 0.3));
  const double most = most_pull(100, 0.3);
  const auto pulled = [&](double part, double time) {
    plane.put(part * most / 1000 / 0.2, 0);
    plane.commit(time);
    return plane.element->remarks(plane.state.history);
  };
  EXPECT_TRUE(pulled(0.99, 0.1).empty());
  EXPECT_TRUE(pulled(1, 0.2).empty()) << "just held";
  EXPECT_EQ(pulled(1.1, 0.3).size(), 1U);
  pulled(1.2, 0.4);
  const double used = plane.channel("GRIP_USED");
  const auto remarks = pulled(0.5, 0.5);
  ASSERT_EQ(remarks.size(), 1U) << "an elastic span does not push";
  EXPECT_TRUE(remarks[0].starts_with(fmt::format("GRIP_USED passed 1 at t = 0.3 and was {:.4g} at most, at t = 0.4", used)))
      << remarks[0];
}

TEST(Belt, RemarksOnARigidBeltThatPushes) {
  for (const double preload : {40.0, 0.0}) {
    Plane plane(rigid(preload));
    plane.state.multipliers[0] = -100;
    plane.commit(0.7);
    const auto remarks = plane.element->remarks(plane.state.history);
    ASSERT_EQ(remarks.size(), preload > 0 ? 1U : 0U) << "without preload it is a ratio, not a belt";
    if (preload > 0) {
      EXPECT_TRUE(remarks[0].starts_with("SLACK_SIDE fell below 0 at t = 0.7 and was -10 at least, at t = 0.7")) << remarks[0];
    }
  }
}

TEST(Belt, RigidRatioOverManyTurnsAndRoundTheFirstPulley) {
  for (const bool crossed : {false, true}) {
    BeltData data;
    data.crossed = crossed;
    Plane plane(data);
    const double side = crossed ? -1 : 1;
    for (int k = 0; k <= 30000; ++k) {
      // the line of centres goes round by `line`; both pulleys turn in the ratio seen from it
      const double turn = 0.9 * k, line = -0.2 * k;
      plane.state.turn(0, rotation_exp(Vec3(0, 0, line + turn)), Vec3::Zero());
      plane.state.turn(1, rotation_exp(Vec3(0, 0, line + side * turn / 2)), Vec3::Zero());
      plane.state.nodes[1].x = {std::cos(line), std::sin(line), 0};
      plane.state.commit(*plane.element);
    }
    EXPECT_NEAR(-residual_of(*plane.element, plane.state).back(), 0, 2e-9) << "constraint after 4300 turns";
  }
}

TEST(Belt, RigidTensions) {
  Plane plane(rigid(40));
  plane.state.multipliers[0] = -30;
  EXPECT_NEAR(plane.channel("TENSION_1"), 55, 1e-13);
  EXPECT_NEAR(plane.channel("TENSION_2"), 25, 1e-13);
  EXPECT_NEAR(plane.channel("TORQUE_2"), 0.4 * 30, 1e-13);
}

TEST(Belt, FaultsOfTheCard) {
  const auto message = [&](BeltData data) {
    Diagnostics diagnostics;
    data.nodes = {1, 2};
    data.axis = {0, 0, 1};
    const NodeMap nodes = Plane::nodes();
    EXPECT_EQ(build(belt_type(), data, nodes, {.diagnostics = &diagnostics}), nullptr);
    return diagnostics.all().empty() ? std::string() : diagnostics.all().front().message;
  };
  BeltData data;
  data.radii = {0.6, 0.7};
  data.crossed = true;
  EXPECT_EQ(message(data), "the pulleys are 1 apart: no belt runs crossed between them");
  data.radii = {0.2, 0.4};
  data.damping = 1;
  EXPECT_EQ(message(data), "a rigid belt has no damping");
  data.stiffness = 1;
  EXPECT_EQ(message(data), "damping without a preload");
  data.rigidity = 1;
  EXPECT_EQ(message(data), "K and EA both give the stiffness of the spans");
}

}  // namespace
}  // namespace engrane::elements::control
