// SPDX-License-Identifier: BSD-3-Clause
#include "solve/run/step_control.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace engrane::solve {
namespace {

using Landing = StepControl::Landing;

constexpr int order = 3;
const std::vector<int> apart{-1, -1}, touching{1, -1};

SolverOptions options() {
  SolverOptions o;
  o.tolerance = 1e-3;
  o.longest = 1;
  return o;
}

TEST(StepControl, BehindAnEventBeginsWithWhatWasToldThere) {
  StepControl control(options(), order);
  EXPECT_EQ(control.enter(apart, 0.1), 0.1);  // nobody has been there
  const double told = control.after(0.1, 1e-3, 0.1);
  EXPECT_EQ(told, 0.2);
  EXPECT_EQ(control.enter(touching, told), told);
  control.after(0.01, 0.7, 0.01);
  EXPECT_EQ(control.enter(apart, 0.01), 0.2);
  EXPECT_EQ(control.enter(touching, 0.2), 0.01);
}

TEST(StepControl, LandingsTellOfLongerStepsOnlyWhereTheseWentTooFar) {
  StepControl control(options(), order);
  control.enter(apart, 0.1);
  control.after(0.1, 1e-3, 0.1);
  control.enter(apart, 1);
  control.after(0.02, 1e-3, 0.2, Landing::foreseen);
  EXPECT_EQ(control.enter(apart, 1), 0.2);
  control.after(0.02, 1e-3, 0.2, Landing::sought);
  EXPECT_DOUBLE_EQ(control.enter(apart, 1), 1.2 * 0.02);
}

TEST(StepControl, DoesNotComeBackToARefusedLengthAtOnce) {
  // an error that rounding hides reads as nothing; it grows with the cube of the step all the same
  StepControl control(options(), order);
  const double retried = control.retry(0.1, 8);
  EXPECT_DOUBLE_EQ(retried, 0.9 * 0.1 / 2);
  double step = control.after(retried, 0, retried);
  EXPECT_EQ(step, retried);
  for (int i = 0; i < 3; ++i) step = control.after(step, 0, step);
  EXPECT_LT(step, 0.1);
  for (int i = 0; i < 10; ++i) step = control.after(step, 0, step);
  EXPECT_GT(step, 0.1);
}

TEST(StepControl, ComesBackAtOnceWhereErrorsAreLargeHoweverShortTheStep) {
  StepControl control(options(), order);
  const double retried = control.retry(0.1, 1e6);
  EXPECT_DOUBLE_EQ(retried, 0.02);
  EXPECT_EQ(control.after(retried, 0, retried), retried);
  EXPECT_EQ(control.after(retried, 0, retried), 2 * retried);
}

TEST(StepControl, GoesOnAfterARestart) {
  StepControl control(options(), order), other(options(), order);
  control.enter(apart, 0.1);
  control.after(0.1, 0.5, 0.1);
  control.enter(touching, 0.1);
  Snapshot snapshot;
  control.save(snapshot);
  other.load(snapshot, apart.size());
  EXPECT_EQ(control.after(0.01, 0.3, 0.01), other.after(0.01, 0.3, 0.01));
  for (const std::vector<int>& sides : {apart, touching}) EXPECT_EQ(control.enter(sides, 7), other.enter(sides, 7));
}

}  // namespace
}  // namespace engrane::solve
