// SPDX-License-Identifier: BSD-3-Clause
#include "math/extrapolation.hpp"

#include <gtest/gtest.h>

#include <array>

namespace engrane {
namespace {

std::array<double, 2> parabolas(double t) { return {3 - 2 * t + 5 * t * t, 7 * t}; }

TEST(Extrapolation, ContinuesParabolasThroughUnequalSteps) {
  Extrapolation e(3, 2);
  for (const double t : {-5.0, 0.0, 0.1, 0.25}) e.add(t, parabolas(t));
  std::array<double, 2> found{};
  e.at(0.4, 0.15, found);
  EXPECT_NEAR(found[0], parabolas(0.4)[0], 1e-13);
  EXPECT_NEAR(found[1], parabolas(0.4)[1], 1e-13);
}

TEST(Extrapolation, GoesNoFartherThanItsPointsAllow) {
  Extrapolation e(3, 2);
  std::array<double, 2> found{};
  e.add(0, parabolas(0));
  e.at(1, 1, found);
  EXPECT_EQ(found, parabolas(0));  // one value: it stays
  e.add(1, parabolas(1));
  e.at(2, 1, found);
  EXPECT_NEAR(found[0], 2 * parabolas(1)[0] - parabolas(0)[0], 1e-14);  // two: a straight line
  e.add(1.001, parabolas(1.001));
  e.at(2, 0.999, found);
  EXPECT_NEAR(found[1], parabolas(1.001)[1], 1e-14);  // differences of a short step tell nothing about a long one
}

TEST(Extrapolation, GoesOnFromASnapshot) {
  Extrapolation e(3, 2), resumed(3, 2);
  for (const double t : {0.0, 0.1}) e.add(t, parabolas(t));
  Snapshot snapshot;
  e.save(snapshot, "e");
  resumed.load(snapshot, "e");
  std::array<double, 2> a{}, b{};
  e.at(0.2, 0.1, a);
  resumed.at(0.2, 0.1, b);
  EXPECT_EQ(a, b);
  Snapshot nothing;
  Extrapolation(3, 2).save(nothing, "e");
  resumed.load(nothing, "e");
  EXPECT_TRUE(resumed.empty());
}

}  // namespace
}  // namespace engrane
