// SPDX-License-Identifier: BSD-3-Clause
#include "observe/packed_configuration.hpp"

#include <gtest/gtest.h>

#include "math/rotation.hpp"

namespace engrane::test {
namespace {

TEST(PackedConfiguration, LosesNothing) {
  Configuration c;
  c.time = 0.3;
  c.h = 0.1;
  c.nodes.resize(6);
  for (std::size_t i = 0; i < 6; ++i) c.nodes[i].x = Vec3(1.0 / 3, static_cast<double>(i), -2);
  // in each node another member, in the first none
  c.nodes[1].R = rotation_exp(Vec3(0.1, -0.2, 0.3));
  c.nodes[2].T(0, 1) = 1e-300;
  c.nodes[3].v.y() = 2;
  c.nodes[4].W.z() = -3;
  c.nodes[5].a.x() = 4;
  c.nodes[5].A.x() = 5;
  c.scalars = {1};
  c.scalar_rates = {2};
  c.scalar_accelerations = {3};
  c.remainders = {4, 5};
  c.multipliers = {6};
  c.history = {7, 8};
  const Configuration back = observe::PackedConfiguration(c).unpacked();
  EXPECT_EQ(back.time, c.time);
  EXPECT_EQ(back.h, c.h);
  ASSERT_EQ(back.nodes.size(), c.nodes.size());
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(back.nodes[i].x, c.nodes[i].x) << i;
    EXPECT_EQ(back.nodes[i].R, c.nodes[i].R) << i;
    EXPECT_EQ(back.nodes[i].T, c.nodes[i].T) << i;
    EXPECT_EQ(back.nodes[i].v, c.nodes[i].v) << i;
    EXPECT_EQ(back.nodes[i].W, c.nodes[i].W) << i;
    EXPECT_EQ(back.nodes[i].a, c.nodes[i].a) << i;
    EXPECT_EQ(back.nodes[i].A, c.nodes[i].A) << i;
  }
  EXPECT_EQ(back.scalars, c.scalars);
  EXPECT_EQ(back.scalar_rates, c.scalar_rates);
  EXPECT_EQ(back.scalar_accelerations, c.scalar_accelerations);
  EXPECT_EQ(back.remainders, c.remainders);
  EXPECT_EQ(back.multipliers, c.multipliers);
  EXPECT_EQ(back.history, c.history);
}

}  // namespace
}  // namespace engrane::test
