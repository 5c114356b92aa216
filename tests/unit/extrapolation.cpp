// SPDX-License-Identifier: BSD-3-Clause
#include "math/extrapolation.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

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

TEST(Extrapolation, TakesTheLatestOfTwoValuesAtOneTime) {
  Extrapolation e(3, 2);
  std::array<double, 2> found{};
  for (const double t : {0.0, 1.0, 2.0}) e.add(t, parabolas(t));
  e.add(2, std::array{1.0, 2.0});
  EXPECT_EQ(e.points(), 3u);
  e.at(2, 0, found);
  EXPECT_EQ(found, (std::array{1.0, 2.0}));
  e.at(1, 0, found);
  EXPECT_NEAR(found[0], parabolas(1)[0], 1e-14);
}

TEST(Extrapolation, LimitsItsWeights) {
  Extrapolation e(6, 1e9);
  for (const double t : {0.0, 1.0, 3.0, 7.0, 15.0, 31.0}) e.add(t, parabolas(t));  // steps that double
  const auto sum = [](const std::vector<double>& weights) {
    double all = 0;
    for (const double w : weights) all += std::abs(w);
    return all;
  };
  EXPECT_GT(sum(e.weights(24, 0)), 100);
  const std::vector<double> calm = e.weights(24, 0, 5);
  EXPECT_EQ(calm.size(), 4u);
  EXPECT_LE(sum(calm), 5);
  double value = 0;
  for (std::size_t p = 0; p < calm.size(); ++p) value += calm[p] * e.values(p)[0];
  EXPECT_NEAR(value, parabolas(24)[0], 1e-11);
}

TEST(Extrapolation, TellsTheValuesAround) {
  Extrapolation e(3, 2);
  e.add(0, parabolas(0));
  EXPECT_EQ(e.around(0.3).before[0], 3);
  EXPECT_EQ(e.around(0.3).after[0], 3);
  for (const double t : {1.0, 3.0, 4.0}) e.add(t, parabolas(t));  // the first is forgotten
  const Extrapolation::Around found = e.around(2.5);
  EXPECT_EQ(found.before[1], 7);
  EXPECT_EQ(found.after[1], 21);
  EXPECT_EQ(found.part, 0.75);
  EXPECT_EQ(e.around(3).part, 0);
  EXPECT_EQ(e.around(0.5).part, 0);
  EXPECT_EQ(e.around(9).part, 1);
  EXPECT_EQ(e.around(9).after[1], 28);
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
