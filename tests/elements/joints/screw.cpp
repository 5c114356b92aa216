// SPDX-License-Identifier: BSD-3-Clause
#include "elements/joints/screw.hpp"

#include "elements/joints/joint_cases.hpp"

namespace engrane::elements::joints {
namespace {

using namespace suite;

TEST(Screw, Suite) {
  run_suite(joint_subject("joint", screw_type, joint_data(1, 2)));
  run_suite(joint_subject("a on the ground", screw_type, joint_data(0, 2)));
  run_suite(joint_subject("b on the ground", screw_type, joint_data(2, 0)));
}

TEST(Screw, SuiteWithSlideSpring) {
  JointData data = joint_data(2, 1);
  data.slide().stiffness = 12;
  run_suite(joint_subject("spring", screw_type, data));
  data.slide().damping = 3;
  run_suite(damped(joint_subject("spring and damper", screw_type, data)));
}

TEST(Screw, SuiteWithDrivenSlide) {
  for (const char* kind : {"SLIDE", "SPEED"}) {
    JointData data = joint_data(1, 2);
    data.slide().drive.tag = kind;
    data.slide().function = 1;
    run_suite(driven(joint_subject(std::string("driven in ") + kind, screw_type, data)));
  }
}

TEST(Screw, SuiteWithTorsionSpring) {
  JointData data = joint_data(2, 1);
  data.turn().stiffness = 7;
  run_suite(joint_subject("spring", screw_type, data));
  data.turn().damping = 2;
  run_suite(damped(joint_subject("spring and damper", screw_type, data)));
}

TEST(Screw, SuiteWithDrivenTurn) {
  for (const char* kind : {"ANGLE", "SPEED"}) {
    JointData data = joint_data(1, 2);
    data.turn().drive.tag = kind;
    data.turn().function = 1;
    run_suite(driven(joint_subject(std::string("driven in ") + kind, screw_type, data)));
  }
}

TEST(Screw, SuiteWithAllOptions) {
  run_coordinate(screw_type, joint_data(1, 2), slide_of, "SLIDE", false);
  run_coordinate(screw_type, joint_data(1, 2), turn_of, "ANGLE", true);
}

TEST(Screw, SuiteWithFriction) { run_friction(screw_type, joint_data(1, 2)); }
TEST(Screw, SuiteAtRestAndSliding) {
  run_grips(screw_type, joint_data(1, 2), true, {{Check::power, "the force is along the thread, which a random state leaves"}});
}

TEST(Screw, Extremes) { run_joint_extremes(screw_type, joint_data(1, 2)); }

TEST(Screw, AdvancesByItsPitch) {
  JointData data;
  data.axis = {1, 0, 0};
  data.pitch = -0.5;  // left-hand
  JointAtOrigin joint(screw_type, data);
  for (int third = 1; third <= 30; ++third) {
    joint.put({-0.5 * third / 3, 0, 0}, {2 * std::numbers::pi * (third % 3) / 3, 0, 0});
    for (const double gap : joint.gaps()) EXPECT_NEAR(gap, 0, 1e-13) << third;
    joint.accept();
  }
  EXPECT_NEAR(joint.channel("ANGLE"), 20 * std::numbers::pi, 1e-12);
}

TEST(Screw, ForceAndTorque) {
  // virtual work: F p + M 2π = 0
  JointData data;
  data.axis = {1, 0, 0};
  data.pitch = 0.5;
  JointAtOrigin joint(screw_type, data);
  joint.state.multipliers[4] = 8;
  EXPECT_NEAR(joint.channel("FORCE_1"), 8, 1e-14);
  EXPECT_NEAR(joint.channel("MOMENT_1"), -8 * 0.5 / (2 * std::numbers::pi), 1e-14);
}

TEST(Screw, FrictionOnTheThread) {
  // at the mean radius r a load W on the helix of lead angle λ, flanks at α: torque W r tan(λ ± ρ), tan ρ = μ/cos α_n
  const double r = 0.3, mu = 0.2, lead = std::atan(0.5 / (2 * std::numbers::pi * r));
  for (const double flank : {0.0, 30.0})
    for (const double way : {1.0, -1.0}) {
      JointData data;
      data.axis = {0, 0, 1};
      data.pitch = 0.5;
      data.friction = {"CONST", {mu}};
      data.friction_width = 1e-4;
      data.radius = r;
      data.flank = flank;
      JointAtOrigin joint(screw_type, data);
      joint.move({0, 0, way * 0.5 / (2 * std::numbers::pi)}, {0, 0, way});
      joint.state.multipliers[4] = 8;
      const double load = joint.channel("FORCE_Z");  // what the thread lifts
      const double rho = std::atan(mu / std::cos(std::atan(std::tan(flank * std::numbers::pi / 180) * std::cos(lead))));
      EXPECT_NEAR(joint.channel("MOMENT_Z"), -load * r * std::tan(lead + way * rho), 1e-13);
    }
}

TEST(Screw, FaultsOfTheCard) {
  JointData data = joint_data(1, 2);
  data.turn().drive.tag = "ANGLE";
  EXPECT_EQ(joint_fault(screw_type, data), "TURN needs a function of time");
  data.slide().drive.tag = "SLIDE";
  EXPECT_EQ(joint_fault(screw_type, data), "DRIVE and TURN on one screw");
}

}  // namespace
}  // namespace engrane::elements::joints
