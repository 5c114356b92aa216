// SPDX-License-Identifier: BSD-3-Clause
#include "elements/gears/rack_pinion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "elements/grip_states.hpp"
#include "elements/suite.hpp"
#include "math/angle.hpp"
#include "math/rotation.hpp"

namespace engrane::elements::gears {
namespace {

using namespace suite;

struct Case {
  std::string name;
  RackData data;
  Vec3 x_a{0.2, -0.1, 0.3}, x_b{0, 0, 0};

  double radius() const {
    const double helix = data.helix.empty() ? 0 : data.helix[0];
    return 0.5 * data.teeth * data.normal_module / std::cos(helix * degree);
  }
  std::unique_ptr<Element> build(const Mat3& Q, const BuildOptions& options = {}) const {
    RackData turned = data;
    const auto turn = [&](const std::array<double, 3>& v) {
      const Vec3 w = Q * Vec3(v[0], v[1], v[2]);
      return std::array<double, 3>{w[0], w[1], w[2]};
    };
    turned.axis = turn(data.axis);
    turned.direction = turn(data.direction);
    if (data.at) turned.at = turn(*data.at);
    return suite::build(rack_pinion_type(), turned, {{0, Vec3::Zero()}, {1, Q * x_a}, {2, Q * x_b}}, options);
  }
};

/// A pinion about z above or beside its rack; the rack's node is off the pitch plane.
Case rack(std::string name, std::vector<double> helix, bool reversed = false) {
  Case c;
  c.name = std::move(name);
  c.data.nodes = {1, 2};
  c.data.teeth = 17;
  c.data.normal_module = 0.05;
  c.data.helix = helix;
  c.data.axis = {0, 0, 1};
  // crossed helices turn the rack in the pitch plane by their sum
  const double sum = helix.size() > 1 ? (helix[0] + helix[1]) * degree : 0;
  c.data.direction = {std::cos(sum), 0, -std::sin(sum)};
  if (reversed)
    for (double& d : c.data.direction) d = -d;
  c.data.at = {c.x_a[0] + 0.1, c.x_a[1] - c.radius(), c.x_a[2] + 0.2};
  c.x_b = Vec3(0.5, -1.2, 0.4);
  return c;
}

Subject subject(const Case& c) {
  Subject s;
  s.name = c.name;
  s.nodes = {{1, c.x_a}, {2, c.x_b}};
  s.build = [c](const Mat3& Q) { return c.build(Q); };
  s.force = 5;
  s.skip[Check::ideal] = "the separating force is not the gradient of a constraint: SuiteWithoutSeparation";
  return s;
}

std::vector<Case> cases() {
  return {rack("straight", {}), rack("helical", {-20}), rack("travel reversed", {20}, true), rack("crossed", {25, -10})};
}

TEST(RackPinion, Suite) {
  for (const Case& c : cases()) run_suite(subject(c));
}

TEST(RackPinion, SuiteWithoutSeparation) {
  for (Case c : cases()) {
    c.data.separation = {"NO", {}};
    Subject s = subject(c);
    s.skip.clear();
    run_suite(s);
  }
}

TEST(RackPinion, SuiteOfElasticTeeth) {
  for (Case c : cases()) {
    c.data.stiffness = 30;
    c.data.damping = 2;
    c.data.course = {"SQUARE", {1.7, 0.2}};
    c.data.eccentricity_a = {0.01, 30};
    Subject s = subject(c);
    s.tolerance = 1e-7;
    s.step = 2e-4;
    s.skip[Check::lagrange] = "a damper has no potential";
    s.skip[Check::zero] = s.skip[Check::rigid] = "the error is not zero at rest";
    run_suite(s);
  }
}

TEST(RackPinion, SuiteOfRunningDistanceAndSlices) {
  for (const Case& straight : {rack("straight", {}), rack("helical", {-20})})
    for (const double play : {0.03, -0.01, -0.06}) {
      Case c = straight;
      c.data.stiffness = 30;
      c.data.backlash = 0.02;
      c.data.onset = 0.005;
      c.data.width = 0.2;
      c.data.slices = 4;
      Subject s = subject(c);
      s.length = s.turn = 0.01;
      s.scalar = 0.05;
      s.tolerance = 1e-7;
      s.step = 2e-4;
      s.adjust = [play](StateBuffer& state, Random&) { state.scalars[2] = play; };
      s.skip[Check::zero] = s.skip[Check::rigid] = "the onset of contact is rounded";
      run_suite(s);
    }
}

TEST(RackPinion, SuiteOfFriction) {
  for (const char* sliding : {"PITCH", "PROFILE"})
    for (Case c : {rack("straight", {}), rack("helical", {-20})}) {
      c.data.friction = {"STRIBECK", {0.2, 0.1, 0.5}};
      c.data.friction_width = 0.2;
      c.data.rolling = 0.01;
      c.data.sliding = {sliding, {}};
      Subject s = subject(c);
      s.step = 2e-5;
      s.tolerance = 1e-6;
      run_suite(s);
    }
}

TEST(RackPinion, SuiteOfFrictionAtRest) {
  for (const GripState::Mode mode : {GripState::sliding, GripState::holding})
    for (Case c : {rack("straight", {}), rack("helical", {-20})}) {
      c.data.friction = {"STRIBECK", {0.2, 0.1, 0.5}};
      c.data.sticks = true;
      c.data.sliding = {"PROFILE", {}};
      Subject s = subject(c);
      s.step = 2e-5;
      s.tolerance = 1e-6;
      put_grips(s, s.build(Mat3::Identity())->layout(), mode);
      if (mode == GripState::holding) s.skip[Check::power] = "a random state leaves the way along which the flanks are held";
      run_suite(s);
    }
}

TEST(RackPinion, Extremes) {
  for (const double stiffness : {1e-6, 1e15})
    for (Case c : cases()) {
      c.data.stiffness = stiffness;
      c.data.damping = stiffness;
      c.data.backlash = 1e-3;
      run_extreme(subject(c));
    }
}

TEST(RackPinion, WholeTurnsMakeNoDifference) {
  const Case c = rack("straight", {});
  const auto element = c.build(Mat3::Identity());
  const double sense = dynamic_cast<const RackPinion&>(*element).geometry().sense;
  StateBuffer state(*element, {{1, c.x_a}, {2, c.x_b}});
  state.multipliers[0] = 3;
  const auto before = residual_of(*element, state);
  state.history[0] = 1;  // a turn, and the rack a circumference further
  state.scalars[1] = -sense * 2 * std::numbers::pi * c.radius();
  state.nodes[1].x[0] += state.scalars[1];
  const auto after = residual_of(*element, state);
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (i >= 9 && i < 12) continue;  // the moment on the rack: its node has moved away from the contact
    EXPECT_NEAR(after[i], before[i], 1e-12) << i;
  }
}

/// Channels by name.
struct Observed {
  Observed(const Element& element, const StateBuffer& state) : names(element.channels()), values(names.size()) {
    element.observe(state.view(), values);
  }
  double operator()(const std::string& name) const {
    for (std::size_t i = 0; i < names.size(); ++i)
      if (names[i].name == name) return values[i];
    throw std::runtime_error("no channel " + name);
  }
  Vec3 vector(const std::string& name) const { return {(*this)(name + "X"), (*this)(name + "Y"), (*this)(name + "Z")}; }
  std::vector<Channel> names;
  std::vector<double> values;
};

// The force channels as a user may sum them: opposite forces, moments that close about any point, forces that act at the contact
// point, and components along the pair's own directions. Pinion and rack have moved on, together.
TEST(RackPinion, ForceChannelsClose) {
  for (Case c : {rack("straight", {}), rack("helical", {20}), rack("reversed", {20}, true), rack("oblique", {20, -5})})
    for (const bool friction : {false, true}) {
      if (friction) {
        c.data.friction = {"CONST", {0.2}};
        c.data.friction_width = 1e-3;
      }
      const auto element = c.build(Mat3::Identity());
      const RackPinion::Geometry& g = dynamic_cast<const RackPinion&>(*element).geometry();
      const Vec3 direction(c.data.direction[0], c.data.direction[1], c.data.direction[2]);
      StateBuffer state(*element, {{1, c.x_a}, {2, c.x_b}});
      const double turn = 0.8, travel = 0.3;
      state.nodes[0].R = rotation_exp(Vec3(0, 0, turn));
      state.scalars[0] = turn;
      state.scalars[1] = travel;
      state.nodes[1].x = c.x_b + travel * direction;
      state.multipliers = {3, -2, 0.4};
      state.nodes[0].W = Vec3(0, 0, 2);
      const Observed on(*element, state);
      const Vec3 force_a = on.vector("FORCE_A"), force_b = on.vector("FORCE_B");
      const Vec3 moment_a = on.vector("MOMENT_A"), moment_b = on.vector("MOMENT_B"), contact = on.vector("CONTACT_");
      EXPECT_GT(force_a.norm(), 1);
      EXPECT_LT((force_a + force_b).norm(), 1e-13) << c.name;
      const Vec3 x_a = state.nodes[0].x, x_b = state.nodes[1].x;
      EXPECT_LT((moment_a + cross(x_a, force_a) + moment_b + cross(x_b, force_b)).norm(), 1e-13) << c.name;
      // the pinion rolls: the contact point stays where it was, and the rack's node has moved on from it
      EXPECT_LT((contact - (c.x_a + g.design.radius(0) * g.frames.mu.col(1))).norm(), 1e-13) << c.name;
      const Vec3 couple_a = moment_a - cross(Vec3(contact - x_a), force_a),
                 couple_b = moment_b - cross(Vec3(contact - x_b), force_b);
      EXPECT_LT((couple_a + couple_b).norm(), 1e-13) << c.name;
      const Vec3 tooth = g.frames.mu * tooth_axes(0, g.design.helix[0]).col(0);
      EXPECT_LT((couple_a - couple_a.dot(tooth) * tooth).norm(), 1e-13) << "what phi_3 holds lies along the tooth";
      EXPECT_NEAR(std::abs(couple_a.dot(tooth)), 0.4, 1e-13) << c.name;
      EXPECT_NEAR(on("RACK_FORCE"), force_b.dot(direction), 1e-13) << c.name;
      EXPECT_NEAR(on("TORQUE_A"), moment_a[2], 1e-13) << c.name;
      EXPECT_NEAR(on("TANGENTIAL_FORCE_A"), force_a.dot(g.frames.mu.col(2)), 1e-13) << c.name;
      EXPECT_NEAR(on("RADIAL_FORCE_A"), -force_a.dot(g.frames.mu.col(1)), 1e-13) << c.name;
      EXPECT_NEAR(on("AXIAL_FORCE_A"), force_a[2], 1e-13) << c.name;
    }
}

// Where supports give, the contact point is midway between those of pinion and rack.
TEST(RackPinion, ContactIsMidway) {
  const Case c = rack("helical", {20});
  const auto element = c.build(Mat3::Identity());
  const RackPinion::Geometry& g = dynamic_cast<const RackPinion&>(*element).geometry();
  StateBuffer state(*element, {{1, c.x_a}, {2, c.x_b}});
  const Vec3 a(0.01, -0.02, 0.005), b(-0.004, 0.012, 0.03);
  state.nodes[0].x = state.nodes[0].x + a;
  state.nodes[1].x = state.nodes[1].x + b;
  const Vec3 contact = Observed(*element, state).vector("CONTACT_");
  EXPECT_LT((contact - g.frames.contact - 0.5 * (a + b)).norm(), 1e-14);
}

std::string fault(const Case& c) {
  Diagnostics diagnostics;
  BuildOptions options;
  options.diagnostics = &diagnostics;
  EXPECT_EQ(c.build(Mat3::Identity(), options), nullptr);
  for (const Diagnostic& d : diagnostics.all())
    if (d.severity == Severity::error) return d.message;
  return {};
}

TEST(RackPinion, FaultsOfTheCard) {
  Case c = rack("straight", {});
  (*c.data.at)[1] -= 0.01;
  EXPECT_NE(fault(c).find("0.435 given, 0.425 needed"), std::string::npos) << fault(c);
  c = rack("straight", {});
  c.data.direction = {0, 0, 1};
  EXPECT_EQ(fault(c), "the rack runs along the pinion's axle");
  c = rack("straight", {});
  c.data.direction = {1, 0, 0.2};
  EXPECT_NE(fault(c).find("needed by the helices, 11.3099 degrees away"), std::string::npos) << fault(c);
  c = rack("straight", {});
  c.data.stiffness = 1;
  c.data.damping_ratio = 0.1;
  EXPECT_EQ(fault(c), "XI is measured against the inertia of two wheels");
}

}  // namespace
}  // namespace engrane::elements::gears
