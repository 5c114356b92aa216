// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "base/dimension.hpp"

namespace engrane {
namespace {

TEST(UnitSystem, SiNames) {
  UnitSystem si;
  si.given = true;
  EXPECT_EQ(si.label(dimension::none), "");
  EXPECT_EQ(si.label(dimension::length), "m");
  EXPECT_EQ(si.label(dimension::angle), "rad");
  EXPECT_EQ(si.label(dimension::velocity), "m/s");
  EXPECT_EQ(si.label(dimension::acceleration), "m/s²");
  EXPECT_EQ(si.label(dimension::angular_velocity), "rad/s");
  EXPECT_EQ(si.label(dimension::force), "N");
  EXPECT_EQ(si.label(dimension::moment), "N·m");
  EXPECT_EQ(si.label(dimension::power), "N·m/s");
  EXPECT_EQ(si.label(dimension::inertia), "kg·m²");
  EXPECT_EQ(si.label(dimension::stiffness), "N/m");
  EXPECT_EQ(si.label(dimension::damping), "N·s/m");
  EXPECT_EQ(si.label(dimension::torsional_stiffness), "N·m/rad");
  EXPECT_EQ(si.label(dimension::torsional_damping), "N·m·s/rad");
  EXPECT_EQ(si.label({-1, 1, -2, 0}), "Pa");
  EXPECT_EQ(si.label({-3, 1, 0, 0}), "kg/m³");
}

TEST(UnitSystem, OtherSystems) {
  const UnitSystem millimetres{true, 1e-3, 1e3, 1};
  EXPECT_EQ(millimetres.label(dimension::force), "N");
  EXPECT_EQ(millimetres.label(dimension::moment), "N·mm");
  EXPECT_EQ(millimetres.label({-1, 1, -2, 0}), "MPa");
  EXPECT_DOUBLE_EQ(millimetres.to_si(dimension::moment), 1e-3);
  const UnitSystem inches{true, 0.0254, 175.126835, 1};
  EXPECT_EQ(inches.label(dimension::force), "lbf");
  EXPECT_EQ(inches.label(dimension::stiffness), "lbf/in");
  const UnitSystem odd{true, 0.7, 1, 1};
  EXPECT_EQ(odd.label(dimension::length), "0.7 SI");
}

TEST(UnitSystem, UnnamedUnits) {
  const UnitSystem unnamed;
  EXPECT_EQ(unnamed.label(dimension::force), "[force]");
  EXPECT_EQ(unnamed.label(dimension::length), "[length]");
  EXPECT_EQ(unnamed.label(dimension::velocity), "[length/time]");
  EXPECT_EQ(unnamed.label(dimension::stiffness), "[force/length]");
}

}  // namespace
}  // namespace engrane
