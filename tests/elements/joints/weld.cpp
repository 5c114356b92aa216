// SPDX-License-Identifier: BSD-3-Clause
#include "elements/joints/weld.hpp"

#include "elements/joints/joint_cases.hpp"

namespace engrane::elements::joints {
namespace {

using namespace suite;

TEST(Weld, Suite) {
  run_suite(joint_subject("joint", weld_type, joint_data(1, 2)));
  run_suite(joint_subject("a on the ground", weld_type, joint_data(0, 2)));
  run_suite(joint_subject("b on the ground", weld_type, joint_data(2, 0)));
}

TEST(Weld, Extremes) { run_joint_extremes(weld_type, joint_data(1, 2)); }

TEST(Weld, HoldsEveryWay) {
  JointAtOrigin joint(weld_type, JointData{});
  // gaps along x, y, z; the Rodrigues vector 2 tan(θ/2) n
  const Vec3 turn = 2.4 * Vec3(2, -1, 2) / 3;
  joint.put({0.1, 0.2, 0.3}, turn);
  const auto phi = joint.gaps();
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(phi[i], 0.1 * static_cast<double>(i + 1), 1e-15);
    EXPECT_NEAR(phi[3 + i], 2 * std::tan(1.2) * turn[static_cast<Eigen::Index>(i)] / 2.4, 1e-14);
  }
}

TEST(Weld, ReactionsAreTheMultipliers) {
  JointAtOrigin joint(weld_type, JointData{});
  joint.state.multipliers = {2, 3, 5, 7, 11, 13};
  const char* names[] = {"FORCE_X", "FORCE_Y", "FORCE_Z", "MOMENT_X", "MOMENT_Y", "MOMENT_Z"};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(joint.channel(names[i]), joint.state.multipliers[i], 1e-14);
}

}  // namespace
}  // namespace engrane::elements::joints
