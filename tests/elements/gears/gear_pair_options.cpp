// SPDX-License-Identifier: BSD-3-Clause
// The suite on what goes beyond the founding paper: stiffness that varies, running centre distance, slices, friction.
#include <gtest/gtest.h>

#include "elements/gears/gear_pair_cases.hpp"
#include "elements/grip_states.hpp"
#include "elements/suite.hpp"

namespace engrane::elements::gears {
namespace {

using namespace suite;
using namespace gear_cases;

/// 1 + 0.3 sin 2πx: a course of the stiffness over a tooth.
const FunctionMap& functions() {
  static const FunctionMap map = [] {
    FunctionMap m;
    m[1] = std::make_unique<Wave>(1, 0.3, 2 * std::numbers::pi, 0);
    m[2] = std::make_unique<Wave>(0, 0.01, std::numbers::pi / 180, 0.4);
    m[3] = std::make_unique<Wave>(0.2, 0.05, 3, 0);  // friction over sliding speed
    m[4] = std::make_unique<Wave>(1, 0.1, 0.2, 0);   // and over load
    return m;
  }();
  return map;
}

/// A subject whose states stay near the reference configuration where that is asked for.
Subject near(const Case& c, double length, double turn) {
  Subject s = subject(c);
  s.build = [c](const Mat3& Q) { return c.build(Q, {.functions = &functions()}); };
  s.build_swapped = {};  // what follows ψ_A belongs to wheel A
  s.length = length;
  s.turn = turn;
  s.tolerance = 1e-7;
  s.step = 2e-4;
  return s;
}

void at_approach(Subject& s, const Case& c, double x) {
  s.adjust = [x, c](StateBuffer& state, Random&) {
    const auto element = c.build(Mat3::Identity(), {.functions = &functions()});
    approach(dynamic_cast<const GearPair&>(*element), state, x);
  };
}

TEST(GearOptions, SuiteOfVaryingStiffness) {
  for (const double x : {0.3, -0.25, -0.9, 0.03})
    for (const deck::Tagged& course : {deck::Tagged{"FOURIER", {0.2, -0.1, 0, 0.05}}, deck::Tagged{"TABLE", {1}},
                                       deck::Tagged{"SQUARE", {1.6, 0.3}}, deck::Tagged{}})
      for (const bool power : {false, true}) {
        Case c = helical();
        c.name += " x " + std::to_string(x) + " course " + course.tag + (power ? " power" : "");
        c.data.stiffness = 30;
        c.data.backlash = 0.5;
        c.data.onset = 0.2;
        c.data.course = course;
        if (power) c.data.exponent = {1.2, 0.1};
        c.data.error = {"COS", {0.01}};
        c.data.eccentricity_a = {0.02, 40};
        c.data.eccentricity_b = {0.03};
        c.data.pitch_a = c.data.pitch_b = 2;
        Subject s = near(c, 1, 3);
        at_approach(s, c, x);
        s.skip[Check::zero] = s.skip[Check::rigid] = "the error is not zero at rest";
        run_suite(s);
      }
}

TEST(GearOptions, SuiteOfRunningDistance) {
  for (Case c : {spur(), helical(), internal(), ring_first()})
    for (const double x : {0.08, -0.02, -0.1})
      for (const int slices : {1, 5}) {
        c.data.stiffness = 30;
        c.data.backlash = 0.04;
        c.data.onset = 0.01;
        c.data.running = true;
        c.data.slices = slices;
        c.data.width = 0.2;
        c.data.course = {"FOURIER", {0.2, -0.1}};
        c.data.damping = 2;
        Case named = c;
        named.name += " slices " + std::to_string(slices) + " x " + std::to_string(x);
        Subject s = near(named, 0.004, 0.004);
        at_approach(s, named, x);
        s.scalar = 0.05;
        s.skip[Check::lagrange] = "a damper has no potential";
        s.skip[Check::zero] = s.skip[Check::rigid] = "the onset of contact is rounded";
        run_suite(s);
      }
}

TEST(GearOptions, RunningDistanceIsAPotential) {
  for (Case c : {spur(), internal()}) {
    c.data.stiffness = 30;
    c.data.running = true;
    Subject s = near(c, 0.004, 0.004);
    at_approach(s, c, 0.1);
    s.scalar = 0.05;
    run_suite(s);
  }
}

TEST(GearOptions, SuiteOfRigidRunningTeeth) {
  Case c = spur();
  c.data.running = true;
  Subject s = near(c, 0.004, 0.004);
  s.scalar = 0.05;
  s.skip[Check::ideal] = "the separating force is not the gradient of a constraint";
  run_suite(s);
}

TEST(GearOptions, SuiteOfFriction) {
  for (const Case& kind : {worm(), hypoid(), crossed(), spur()})
    for (const deck::Tagged& friction :
         {deck::Tagged{"CONST", {0.1}}, deck::Tagged{"STRIBECK", {0.2, 0.1, 0.5, 0.01}}, deck::Tagged{"FCT", {3, 4}}})
      for (const double speed : {3.0, 0.05}) {  // beyond and within the regularised speeds
        Case c = kind;
        c.name += " friction " + friction.tag + " at " + std::to_string(speed);
        c.data.friction = friction;
        c.data.friction_width = 0.5;
        c.data.rolling = 0.02;
        Subject s = near(c, 1, 3);
        s.velocity = speed;
        s.skip[Check::ideal] = "friction and the separating force are not gradients of constraints";
        run_suite(s);
      }
}

TEST(GearOptions, SuiteOfFrictionAtRest) {
  const std::string profile = "PROFILE", pitch;
  for (const auto& [kind, sliding] : {std::pair{worm(), pitch},
                                      {hypoid(), pitch},
                                      {crossed(), pitch},
                                      {spur(), profile},
                                      {helical(), profile},
                                      {internal(), profile},
                                      {bevel(), profile}})
    for (const GripState::Mode mode : {GripState::sliding, GripState::holding}) {
      Case c = kind;
      c.name += " at rest, mode " + std::to_string(mode);
      c.data.friction = {"STRIBECK", {0.2, 0.1, 0.5, 0.01}};
      c.data.sticks = true;
      c.data.sliding.tag = sliding;
      Subject s = near(c, 1, 3);
      s.states = 8;
      s.step = 2e-5;
      s.tolerance = 1e-6;
      put_grips(s, s.build(Mat3::Identity())->layout(), mode);
      s.skip[Check::ideal] = "friction and the separating force are not gradients of constraints";
      if (mode == GripState::holding) s.skip[Check::power] = "a random state leaves the way along which the flanks are held";
      run_suite(s);
    }
}

TEST(GearOptions, SuiteOfSlidingProfiles) {
  for (const Case& kind : {spur(), helical(), internal(), bevel()})
    for (const bool elastic : {false, true}) {
      Case c = kind;
      c.name += " profile";
      c.data.friction = {"CONST", {0.1}};
      c.data.friction_width = 0.2;
      c.data.sliding = {"PROFILE", {}};
      if (elastic) {
        c.data.stiffness = 30;
        c.data.backlash = 0.4;
        c.data.onset = 0.1;
      }
      Subject s = near(c, 1, 3);
      s.states = 8;
      s.step = 2e-5;
      s.tolerance = 1e-6;
      s.skip[Check::ideal] = "friction and the separating force are not gradients of constraints";
      if (elastic) {
        at_approach(s, c, 0.3);
        s.skip[Check::zero] = s.skip[Check::rigid] = "the onset of contact is rounded";
      }
      run_suite(s);
    }
}

TEST(GearOptions, SuiteOfReliefAndCrowning) {
  for (const Case& kind : {spur(), helical(), internal()})
    for (const bool crowned : {false, true})
      for (const double backlash : {0.0, 0.4}) {
        Case c = kind;
        c.name += " relief";
        c.data.stiffness = 30;
        c.data.tip_relief_a = {0.1, 0.08, 1.5};
        c.data.tip_relief_b = {0.05, 0.06, 2};
        c.data.root_relief_b = {0.02, 0.05, 3};
        if (crowned) c.data.crown = 0.2;
        if (backlash > 0) {
          c.data.backlash = backlash;
          c.data.onset = 0.1;
        }
        Subject s = near(c, 1, 3);
        s.states = 8;
        s.step = 2e-5;
        s.tolerance = 1e-6;
        s.skip[Check::ideal] = "the separating force is not a gradient of a constraint";
        at_approach(s, c, 0.3);
        s.skip[Check::zero] = s.skip[Check::rigid] = "the teeth press";
        run_suite(s);
      }
}

}  // namespace
}  // namespace engrane::elements::gears
