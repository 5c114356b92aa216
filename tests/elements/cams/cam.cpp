// SPDX-License-Identifier: BSD-3-Clause
#include "elements/cams/cam.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "elements/cams/cam_motion.hpp"
#include "elements/cams/profiles.hpp"
#include "elements/suite.hpp"
#include "math/angle.hpp"
#include "math/rotation.hpp"

namespace engrane::elements::cams {
namespace {

using namespace suite;

using std::numbers::pi;
std::array<double, 3> list(const Vec3& v) { return {v[0], v[1], v[2]}; }

std::vector<double> oval_table() {
  std::vector<double> polar = oval(), table;
  for (std::size_t k = 0; k < polar.size(); k += 2)
    for (const double c : {std::cos(polar[k] * degree), std::sin(polar[k] * degree)}) table.push_back(polar[k + 1] * c);
  return table;
}

enum class Profile { table, polar, star, inside, motion, arm };

struct Kind {
  Profile profile = Profile::motion;
  deck::Tagged follower{"ROLLER", {0.2}};
  std::array<int, 2> ends{1, 2};
  std::optional<double> stiffness = {};
  double exponent = 1;
  deck::Tagged damping = {}, friction = {};
  bool at_node = false;  ///< the follower's point is node b itself
};

constexpr double base = 0.5, offset = 0.1;
const Vec3 axis = Vec3(0.3, -0.5, 0.7).normalized(), center(0.2, -0.1, 0.3);
const Vec3 way = cross(axis, Vec3(Vec3::UnitX())).normalized(), side = cross(axis, way);

/// Where the follower's point is in the reference configuration: on the base circle, off the line through the centre.
Vec3 follower_place(const Kind& kind) {
  const double radius = kind.follower.is("ROLLER") ? kind.follower.values[0] : 0;
  if (kind.follower.is("FLAT")) return center + base * way + 0.3 * side;
  return center + std::sqrt((base + radius) * (base + radius) - offset * offset) * way + offset * side + 0.4 * axis;
}
const Vec3 pivot = center + 1.1 * way + 0.8 * side;

CamData card(const Kind& kind, const Mat3& Q) {
  CamData data;
  data.nodes = kind.ends;
  data.axis = list(Q * axis);
  data.center = list(Q * center);
  data.follower = kind.follower;
  const bool motion = kind.profile == Profile::motion || kind.profile == Profile::arm;
  if (motion) {
    data.motion = {90, kind.profile == Profile::arm ? 10 : 0.1, 70, kind.profile == Profile::arm ? 10 : 0.1, 100, 0, 100, 0};
    data.laws = {"POLY4567", "CYCLOIDAL", "MODIFIED_SINE", "CYCLOIDAL"};
    data.base = base;
    data.phase = 40;  // the reference configuration dwells on the base circle
  } else {
    data.zero = list(Q * Vec3(way + 0.2 * axis));
    if (kind.profile == Profile::polar) data.polar = oval();
    if (kind.profile == Profile::star) data.polar = star();
    if (data.polar.empty()) data.table = oval_table();
    if (kind.profile == Profile::inside) data.side = {"INSIDE", {}};
  }
  if (kind.profile == Profile::arm)
    data.pivot = list(Q * pivot);
  else
    data.direction = list(Q * way);
  if (kind.follower.is("FLAT")) data.normal = list(Q * Vec3(way + 0.1 * side));
  if (!kind.at_node) data.at = list(Q * follower_place(kind));
  data.stiffness = kind.stiffness;
  data.exponent = kind.exponent;
  data.damping = kind.damping;
  data.friction = kind.friction;
  if (kind.friction.given()) data.friction_width = 0.05;
  return data;
}

/// In the places of the nodes the followers with `at_node` are where the profile is.
NodeMap places(const Kind& kind) {
  return {{0, Vec3::Zero()}, {1, {1, 0.2, -0.3}}, {2, kind.at_node ? follower_place(kind) : Vec3(-0.5, 0.4, 0.8)}};
}

Subject subject(const Kind& kind) {
  Subject s;
  s.name = kind.follower.tag + (kind.stiffness ? " K" : "") + " " + kind.damping.tag + " " + kind.friction.tag + " profile " +
           std::to_string(static_cast<int>(kind.profile)) + " of " + std::to_string(kind.ends[0]);
  s.nodes = places(kind);
  s.build = [=](const Mat3& Q) { return build(cam_type(), card(kind, Q), turned(places(kind), Q)); };
  s.states = 40;
  s.length = 0.5;
  s.velocity = 0.5;
  s.force = 5;
  // third derivatives of profiles jump between their pieces, which differences must not straddle
  s.step = 1e-4;
  s.tolerance = 1e-7;
  // brings the follower near the profile, wherever the bodies are: outside it, or far enough in to be pressed
  s.adjust = [=](StateBuffer& state, Random& random) {
    const bool flat = kind.follower.is("FLAT");
    const double radius = flat                              ? 0.1 * std::abs(uniform(random))
                          : kind.profile == Profile::star   ? 0.68 + 0.03 * uniform(random)
                          : kind.profile == Profile::inside ? 0.25 + 0.05 * uniform(random)
                          : kind.stiffness                  ? 0.72 + 0.03 * uniform(random)
                                                            : 0.9 + 0.2 * uniform(random);
    const double angle = pi * uniform(random);
    const Vec3 in_cam = center + radius * (std::cos(angle) * way + std::sin(angle) * side) + 0.3 * uniform(random) * axis;
    NodeState &a = state.nodes[0], &b = state.nodes[1];
    const NodeMap at = places(kind);
    const Vec3 point = (kind.at_node ? at.at(kind.ends[1]) : follower_place(kind)) - at.at(kind.ends[1]);
    const auto put = [&] {
      const Vec3 lever = a.R * (in_cam - at.at(kind.ends[0]));
      if (kind.ends[1] != 0)
        b.x = a.x + lever - b.R * point;
      else
        a.x = b.x + b.R * point - lever;
    };
    put();
    if (!flat || kind.profile != Profile::polar) return;
    // the contact runs fast along a face that is tilted: keep it off the knots, which are 30 degrees apart
    const auto cam = build(cam_type(), card(kind, Mat3::Identity()), at);
    while (std::abs(std::remainder(channel_of(*cam, state, "CAM_ANGLE"), 30 * degree)) < 5 * degree) {
      state.turn(1, uniform_rotation(random), Vec3::Zero());
      put();
    }
  };
  const bool made = kind.profile == Profile::motion && !kind.stiffness && !kind.follower.is("FLAT");
  if (!made)
    for (const Check check : {Check::zero, Check::rigid})
      s.skip[check] = "the follower is not on the profile in the reference configuration";
  if (kind.damping.given() || kind.friction.given()) s.skip[Check::lagrange] = "damping has no potential";
  if (kind.friction.given()) s.skip[Check::ideal] = "friction is no constraint force";
  return s;
}

TEST(Cam, Suite) {
  const deck::Tagged knife{"KNIFE", {}}, roller{"ROLLER", {0.2}}, flat{"FLAT", {}};
  for (const Kind& kind :
       {Kind{},
        Kind{.profile = Profile::arm},
        Kind{.profile = Profile::table},
        Kind{.profile = Profile::polar},
        Kind{.profile = Profile::inside, .follower = roller},
        Kind{.follower = knife},
        Kind{.follower = flat},
        Kind{.profile = Profile::polar, .follower = flat},
        Kind{.ends = {0, 2}},
        Kind{.ends = {1, 0}},
        Kind{.at_node = true},
        Kind{.follower = flat, .ends = {0, 2}},
        Kind{.follower = flat, .ends = {1, 0}},
        Kind{.follower = knife, .at_node = true},
        Kind{.follower = knife, .friction = {"CONST", {0.3}}},
        Kind{.follower = flat, .friction = {"STRIBECK", {0.3, 0.1, 0.4}}},
        Kind{.stiffness = 40, .exponent = 1.5, .damping = {"HUNT", {0.3}}},
        Kind{.stiffness = 40, .damping = {"LINEAR", {0.4}}},
        Kind{.profile = Profile::table, .stiffness = 40, .exponent = 1.5},
        Kind{.profile = Profile::arm, .stiffness = 40},
        Kind{.follower = flat, .stiffness = 40, .exponent = 1.5, .damping = {"HUNT", {0.3}}, .friction = {"CONST", {0.2}}},
        Kind{.profile = Profile::polar, .follower = flat, .stiffness = 40},
        Kind{.follower = flat, .ends = {0, 2}, .stiffness = 40},
        Kind{.profile = Profile::star, .follower = {"ROLLER", {0.35}}, .stiffness = 40, .damping = {"LINEAR", {0.4}}},
        Kind{.profile = Profile::star, .follower = flat, .stiffness = 40, .friction = {"CONST", {0.2}}}})
    run_suite(subject(kind));
}

TEST(Cam, Extremes) {
  for (const Profile profile : {Profile::motion, Profile::table})
    for (const char* follower : {"ROLLER", "FLAT"})
      for (const double stiffness : {1e-6, 1e15}) {
        Kind kind{.profile = profile, .stiffness = stiffness, .damping = {"HUNT", {1e6}}};
        if (std::string(follower) == "FLAT") kind.follower = {"FLAT", {}};
        run_extreme(subject(kind));
        kind.stiffness.reset();
        kind.damping = {};
        if (kind.follower.is("ROLLER") || profile == Profile::motion) run_extreme(subject(kind));
      }
}

/// A cam about z at the origin with its follower on node 2, straight above it or on an arm; the cam turns at a constant speed.
struct Turning {
  explicit Turning(CamData wished) : data(std::move(wished)) {
    data.nodes = {1, 2};
    data.axis = {0, 0, 1};
    data.base = 0.03;
    data.motion = {80, 1, 50, 1, 110, 0, 120, 0};
    for (const std::size_t k : {1u, 3u}) data.motion[k] = data.pivot ? 12 : 0.01;
    cam = build(cam_type(), data, nodes);
  }
  /// Lift and its derivatives by the cam's turn, from the deck's numbers alone.
  Jet lift(double turn) const {
    double angle = turn / degree;
    const double top = data.pivot ? 12 * degree : 0.01;
    const auto law = cam_law(data.laws[0]);
    if (angle < 80) {
      const Jet j = stretched(unit_rise(*law, angle / 80), 1 / (80 * degree));
      return {top * j.f, top * j.d1, top * j.d2, top * j.d3};
    }
    if (angle < 130) return {top, 0, 0, 0};
    if (angle >= 240) return {};
    const Jet j = stretched(unit_rise(*law, (angle - 130) / 110), 1 / (110 * degree));
    return {top - top * j.f, -top * j.d1, -top * j.d2, -top * j.d3};
  }
  /// The cam at `turn`, turning at `speed`.
  StateBuffer state(double turn, double speed) const {
    StateBuffer s(*cam, nodes);
    s.turn(0, rotation_exp(Vec3(0, 0, turn)), Vec3::Zero());
    s.nodes[0].W = {0, 0, speed};
    return s;
  }

  CamData data;
  NodeMap nodes = {{1, Vec3::Zero()}, {2, {0, 0.04, 0}}};
  std::unique_ptr<Element> cam;
};

void expect_on_profile(const Turning& t, const StateBuffer& s, double turn) {
  double phi = 1, rate = 1, second = 1;
  t.cam->constraint_rates(s.view(), {&phi, 1}, {&rate, 1}, {&second, 1});
  EXPECT_NEAR(phi, 0, 1e-15) << turn / degree << " degrees";
  EXPECT_NEAR(rate, 0, 1e-14) << turn / degree << " degrees";
  EXPECT_NEAR(second, 0, 1e-12) << turn / degree << " degrees";
}

TEST(Cam, GivesTheFollowerItsMotion) {
  const double speed = 3;
  for (const char* law : {"CYCLOIDAL", "MODIFIED_SINE", "POLY345", "POLY4567", "HARMONIC"})
    for (const deck::Tagged& follower : {deck::Tagged{"KNIFE", {}}, {"ROLLER", {0.01}}, {"FLAT", {}}})
      for (const double aside : {0.0, 0.006}) {
        CamData data;
        data.laws = {law};
        data.follower = follower;
        data.direction = {{0, 1, 0}};
        data.at = {{aside, 0.04, 0}};
        const Turning t(data);
        const double start = 0.03 + (follower.is("ROLLER") ? 0.01 : 0),
                     reach = follower.is("FLAT") ? start : std::sqrt(start * start - aside * aside);
        for (double turn = 1.3 * degree; turn < 2 * pi; turn += 7.9 * degree) {
          const Jet lift = t.lift(turn);
          StateBuffer s = t.state(turn, speed);
          s.nodes[1].x = {0, reach + lift.f, 0};  // node 2 starts at 0.04, where the point is
          s.nodes[1].v = {0, speed * lift.d1, 0};
          s.nodes[1].a = {0, speed * speed * lift.d2, 0};
          expect_on_profile(t, s, turn);
          s.multipliers[0] = 7;
          EXPECT_NEAR(channel_of(*t.cam, s, "LIFT"), lift.f, 1e-13);
          if (follower.is("FLAT")) {
            EXPECT_NEAR(channel_of(*t.cam, s, "RADIUS_OF_CURVATURE"), 0.03 + lift.f + lift.d2, 1e-12);
            EXPECT_NEAR(channel_of(*t.cam, s, "PRESSURE_ANGLE"), 0, 1e-12);
            EXPECT_NEAR(channel_of(*t.cam, s, "FORCE_Y"), 7, 1e-13);
            // the force acts where the face touches, beside the way by the derivative of the lift
            EXPECT_NEAR(residual_of(*t.cam, s)[5], 7 * lift.d1, 1e-12);
            EXPECT_NEAR(channel_of(*t.cam, s, "SLIDING_SPEED"), std::abs(speed * (reach + lift.f)), 1e-12);
          } else {
            // Norton, eq. 7.31d
            const double tangent = (lift.d1 - aside) / (reach + lift.f);
            EXPECT_NEAR(channel_of(*t.cam, s, "PRESSURE_ANGLE"), std::abs(std::atan(tangent)), 1e-11);
            EXPECT_NEAR(channel_of(*t.cam, s, "POWER"), 7 * std::cos(std::atan(tangent)) * speed * lift.d1, 1e-12);
            if (aside == 0) {
              const double R = reach + lift.f, square = R * R + lift.d1 * lift.d1;
              const double path = std::pow(square, 1.5) / (square + lift.d1 * lift.d1 - R * lift.d2);
              EXPECT_NEAR(1 / (channel_of(*t.cam, s, "RADIUS_OF_CURVATURE") + (start - 0.03)), 1 / path, 1e-9);
            }
          }
        }
      }
}

TEST(Cam, SwingsTheArmItIsMadeFor) {
  const double speed = 3;
  for (const double sign : {1.0, -1.0}) {
    CamData data;
    data.laws = {"MODIFIED_SINE"};
    data.follower = {"ROLLER", {0.01}};
    data.pivot = {{sign * 0.06, 0, 0}};
    const Turning t(data);
    const Vec3 pivot_at(sign * 0.06, 0, 0);
    const double arm = std::hypot(0.06, 0.04);
    // the triangle of centre, pivot and roller on the base circle
    const double angle = std::acos((0.06 * 0.06 + arm * arm - 0.04 * 0.04) / (2 * 0.06 * arm));
    ASSERT_NEAR(angle, std::atan2(0.04, 0.06), 1e-14);
    for (double turn = 1.3 * degree; turn < 2 * pi; turn += 7.9 * degree) {
      const Jet lift = t.lift(turn);
      const double a = angle + lift.f;
      StateBuffer s = t.state(turn, speed);
      const Vec3 e(-sign * std::cos(a), std::sin(a), 0), along(sign * std::sin(a), std::cos(a), 0);
      s.nodes[1].x = pivot_at + arm * e;
      s.nodes[1].v = arm * speed * lift.d1 * along;
      s.nodes[1].a = arm * speed * speed * (lift.d2 * along - lift.d1 * lift.d1 * e);
      s.turn(1, rotation_exp(Vec3(0, 0, -sign * lift.f)), Vec3::Zero());
      expect_on_profile(t, s, turn);
      EXPECT_NEAR(channel_of(*t.cam, s, "LIFT"), lift.f, 1e-12);
      // the velocity along the normal is that of the cam: v_n = w times the normal's distance from the centre
      s.multipliers[0] = 1;
      const double alpha = channel_of(*t.cam, s, "PRESSURE_ANGLE");
      EXPECT_NEAR(channel_of(*t.cam, s, "POWER"), std::cos(alpha) * s.nodes[1].v.dot(along), 1e-12);
    }
  }
}

TEST(Cam, WhatTheListingTells) {
  CamData data;
  data.laws = {"CYCLOIDAL"};
  data.follower = {"ROLLER", {0.01}};
  data.direction = {{0, 1, 0}};
  const Turning t(data);
  EXPECT_NEAR(derived_of(*t.cam, "base circle"), 0.03, 1e-15);
  EXPECT_NEAR(derived_of(*t.cam, "greatest radius"), 0.04, 1e-15);
  double steepest = 0, sharpest = 0;
  for (int k = 0; k < 360000; ++k) {
    const Jet lift = t.lift(2 * pi * k / 360000);
    const double R = 0.04 + lift.f, square = R * R + lift.d1 * lift.d1;
    steepest = std::max(steepest, std::atan(std::abs(lift.d1) / R));
    sharpest = std::max(sharpest, (square + lift.d1 * lift.d1 - R * lift.d2) / std::pow(square, 1.5));
  }
  EXPECT_NEAR(derived_of(*t.cam, "greatest pressure angle"), steepest, 1e-9);
  EXPECT_NEAR(derived_of(*t.cam, "least radius of curvature of the roller's path"), 1 / sharpest, 1e-9);
  EXPECT_NEAR(derived_of(*t.cam, "least radius of curvature of the profile"), 1 / sharpest - 0.01, 1e-9);

  data.follower = {"FLAT", {}};
  const Turning flat(data);
  // the steepest fall of the speed: s + s'' is least near the end of the rise
  double least = 1;
  for (int k = 0; k < 360000; ++k) {
    const Jet lift = flat.lift(2 * pi * k / 360000);
    least = std::min(least, 0.03 + lift.f + lift.d2);
  }
  EXPECT_NEAR(derived_of(*flat.cam, "least radius of curvature of the profile"), least, 1e-9);
}

TEST(Cam, AGrooveKeepsItsBranch) {
  // a slot: two long branches 0.1 apart; a pin that is nearer to the other branch stays on its own
  CamData data;
  data.nodes = {1, 2};
  data.axis = {0, 0, 1};
  data.zero = {{1, 0, 0}};
  for (int k = 0; k <= 40; ++k) data.table.insert(data.table.end(), {-0.5 + k * 0.025, -0.05});
  for (int k = 0; k <= 40; ++k) data.table.insert(data.table.end(), {0.5 - k * 0.025, 0.05});
  data.follower = {"KNIFE", {}};
  const NodeMap nodes = {{1, Vec3::Zero()}, {2, {0.1, -0.05, 0}}};
  const auto cam = build(cam_type(), data, nodes);
  StateBuffer state(*cam, nodes);
  state.commit(*cam);
  state.nodes[1].x = {0.13, 0.02, 0};
  EXPECT_NEAR(channel_of(*cam, state, "GAP"), -0.07, 1e-9);
}

TEST(Cam, SwitchesAndTheirRates) {
  for (const deck::Tagged& damping : {deck::Tagged{"HUNT", {0.3}}, {"LINEAR", {2}}})
    for (const char* follower : {"ROLLER", "FLAT"}) {
      Kind kind{.profile = Profile::polar, .stiffness = 40, .exponent = 1.5, .damping = damping};
      if (std::string(follower) == "FLAT") kind.follower = {"FLAT", {}};
      const Subject s = subject(kind);
      const auto cam = s.build(Mat3::Identity());
      const std::size_t count = cam->layout().switches.size();
      ASSERT_EQ(count, 14u);  // two of the contact, and one for each point of the profile
      Random random(5);
      const StateBuffer state = random_state(s, *cam, random);
      const auto at = [&](double t) {
        std::vector<Switch> values(count);
        cam->switches(state.after(t).view(), values);
        return values;
      };
      const double h = 1e-4;
      for (std::size_t i = 0; i < count; ++i) {
        EXPECT_GT(at(0)[i].size, 0);
        EXPECT_NEAR(at(0)[i].rate, (at(h)[i].value - at(-h)[i].value) / (2 * h), 1e-5 * (1 + std::abs(at(0)[i].rate)));
      }
    }
}

TEST(Cam, SwitchesAtTheJointsOfAMotion) {
  for (const Profile profile : {Profile::motion, Profile::arm})
    for (const char* follower : {"ROLLER", "KNIFE", "FLAT"}) {
      if (profile == Profile::arm && follower == std::string("FLAT")) continue;
      Kind kind{.profile = profile, .follower = {follower, {}}};
      if (kind.follower.is("ROLLER")) kind.follower.values = {0.2};
      const Subject s = subject(kind);
      const auto cam = s.build(Mat3::Identity());
      Random random(7);
      const StateBuffer state = random_state(s, *cam, random);
      const std::size_t count = cam->layout().switches.size();
      ASSERT_EQ(count, 6u);  // both ends of the rise and of the fall, and two within the fall
      const auto at = [&](double t) {
        std::vector<Switch> values(count);
        cam->switches(state.after(t).view(), values);
        return values;
      };
      const double h = 1e-4, angle = channel_of(*cam, state, "CAM_ANGLE");
      for (std::size_t i = 0; i < count; ++i) {
        const double joint = std::array{40.0, 130.0, 200.0, 212.5, 287.5, 300.0}[i] * degree;
        EXPECT_NEAR(std::abs(at(0)[i].value), std::abs(std::sin(0.5 * (angle - joint))), 1e-12);
        EXPECT_NEAR(at(0)[i].rate, (at(h)[i].value - at(-h)[i].value) / (2 * h), 1e-5 * (1 + std::abs(at(0)[i].rate)));
      }
    }
}

/// First message about a card with a cycloidal motion and a roller, changed by `change`.
std::string message(const std::function<void(CamData&)>& change, bool warning = false) {
  CamData data;
  data.nodes = {1, 2};
  data.axis = {0, 0, 1};
  data.base = 0.03;
  data.motion = {90, 0.01, 90, 0.01, 90, 0, 90, 0};
  data.follower = {"ROLLER", {0.01}};
  data.direction = {{0, 1, 0}};
  change(data);
  Diagnostics diagnostics;
  const auto cam =
      build(cam_type(), data, {{0, Vec3::Zero()}, {1, Vec3::Zero()}, {2, {0, 0.04, 0}}}, {.diagnostics = &diagnostics});
  EXPECT_EQ(cam != nullptr, warning);
  return diagnostics.all().empty() ? std::string() : diagnostics.all().front().message;
}

TEST(Cam, FaultsOfTheCard) {
  EXPECT_EQ(message([](CamData& d) { d.motion[0] = 80; }), "the segments of MOTION make 350 degrees: the profile does not close");
  EXPECT_EQ(message([](CamData& d) { d.motion.pop_back(); }), "MOTION has 7 values");
  EXPECT_EQ(message([](CamData& d) { d.laws = {"CYCLOID"}; }), "LAW does not know \"CYCLOID\"");
  EXPECT_EQ(message([](CamData& d) { d.laws = {"POLY345", "POLY345"}; }), "2 laws for 4 segments");
  EXPECT_EQ(message([](CamData& d) { d.base.reset(); }), "a motion needs its base circle");
  EXPECT_EQ(message([](CamData& d) { d.direction.reset(); }), "a motion needs the follower's way");
  EXPECT_EQ(message([](CamData& d) { d.direction = {{0, 0, 2}}; }), "DIRECTION is along AXIS");
  EXPECT_EQ(message([](CamData& d) {
              d.at = {{0.05, 0.01, 0}};
            }),
            "the follower's way passes the centre at 0.05, and starts 0.04 from it");
  EXPECT_EQ(message([](CamData& d) {
              d.direction.reset();
              d.pivot = {{0.2, 0, 0}};
              d.at = {{0.18, 0.03, 0}};
            }),
            "an arm of 0.0360555 with its pivot 0.2 from the centre does not reach the base circle: its end must come to 0.04 "
            "from the centre");
  EXPECT_EQ(message([](CamData& d) {
              d.motion = {};
              d.base.reset();
            }),
            "a cam without a profile");
  EXPECT_EQ(message([](CamData& d) { d.friction = {"CONST", {0.1}}; }), "a roller rolls on the profile without friction");

  const auto table = [](std::vector<double> points) {
    return [points = std::move(points)](CamData& d) {
      d.motion = {};
      d.base.reset();
      d.zero = {{1, 0, 0}};
      d.table = points;
    };
  };
  std::vector<double> open;
  for (int k = 0; k < 30; ++k) open.insert(open.end(), {std::cos(6 * k * degree), std::sin(6 * k * degree)});
  EXPECT_EQ(message(table(open)),
            "the profile does not close: its last point is 1.99726 from the first, and no others are more than 0.104672 apart");
  std::vector<double> eight;
  for (int k = 0; k < 60; ++k) eight.insert(eight.end(), {std::cos(6 * k * degree), std::sin(12 * k * degree)});
  EXPECT_EQ(message(table(eight)).substr(0, 33), "the profile crosses itself near (");
  std::vector<double> bean;
  for (int k = 0; k < 60; ++k) {
    const double a = 6 * k * degree, r = 0.05 - 0.02 * std::cos(2 * a);
    bean.insert(bean.end(), {r * std::cos(a), r * std::sin(a)});
  }
  EXPECT_EQ(message([&](CamData& d) {
              table(bean)(d);
              d.follower.values = {0.05};
            }).substr(0, 61),
            "a roller of radius 0.05 does not fit into the hollow of radiu");
  // one that only pushes touches both sides of the hollow
  EXPECT_EQ(message(
                [&](CamData& d) {
                  table(bean)(d);
                  d.follower.values = {0.05};
                  d.stiffness = 1e6;
                },
                true),
            "");
  EXPECT_EQ(message([&](CamData& d) {
              table(bean)(d);
              d.follower = {"FLAT", {}};
            }).substr(0, 41),
            "the profile is hollow or straight at (0.0");
}

TEST(Cam, FollowerBehindTheCam) {
  EXPECT_EQ(message([](CamData& d) {
              d.direction = {{0, -1, 0}};
            }),
            "DIRECTION points into the cam: along it the follower is 0.04 behind the cam's centre");
  EXPECT_EQ(message([](CamData& d) {
              d.follower = {"FLAT", {}};
              d.at = {{0.02, -0.03, 0}};
            }),
            "the flat face looks into the cam: it is 0.03 behind the cam's centre");
  // on a circle, nothing is behind
  EXPECT_EQ(message(
                [](CamData& d) {
                  d.direction = {{0, -1, 0}};
                  d.motion = {360, 0};
                },
                true),
            "");
}

TEST(Cam, FollowerOffItsBaseCircle) {
  const auto off = [](double circle, std::optional<double> stiffness = {}) {
    return message([&](CamData& d) { d.base = circle, d.stiffness = stiffness; }, true);
  };
  EXPECT_EQ(off(0.025), "the roller's centre is 0.04 from the cam's centre, and 0.035 on the profile at cam angle 0");
  EXPECT_EQ(off(0.0299), "the roller's centre is 0.04 from the cam's centre, and 0.0399 on the profile at cam angle 0");
  EXPECT_EQ(off(0.02998), "");
  // one that rests on its cam may have some play, and may not be pressed in
  EXPECT_EQ(off(0.029, 1e6), "");
  EXPECT_EQ(off(0.025, 1e6), off(0.025));
  EXPECT_EQ(off(0.031, 1e6), "the roller's centre is 0.04 from the cam's centre, and 0.041 on the profile at cam angle 0");
  // half up the rise that follows cam angle -45; the offset 0.024 leaves sqrt(0.04^2 - 0.024^2) = 0.032 on the base circle
  const auto lifted = [](double y) {
    return message(
        [&](CamData& d) {
          d.phase = -45;
          d.at = {{0.024, y, 0.1}};
        },
        true);
  };
  EXPECT_EQ(lifted(0.037), "");
  EXPECT_EQ(lifted(0.032), "the roller's centre is 0.04 from the cam's centre, and 0.0441022 on the profile at cam angle 0");
}

TEST(Cam, Undercut) {
  // a flat face: base + s + s'' must stay positive; the rise is 2 pi h/b^2 steep in its second half
  EXPECT_EQ(message([](CamData& d) {
              d.follower = {"FLAT", {}};
              d.motion = {40, 0.01, 140, 0.01, 90, 0, 90, 0};
            }).substr(0, 51),
            "the profile is undercut and crosses itself: its lea");
  // a roller: the path of its centre bends more sharply than the roller
  EXPECT_EQ(message(
                [](CamData& d) {
                  d.follower = {"ROLLER", {0.03}};
                  d.base = 0.005;
                },
                true)
                .substr(0, 65),
            "the profile is undercut: the roller has a radius of 0.03, and the");
  EXPECT_EQ(message([](CamData&) {}, true), "");
}

}  // namespace
}  // namespace engrane::elements::cams
