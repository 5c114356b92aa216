// SPDX-License-Identifier: BSD-3-Clause
// Steps as the Runner chooses them, with schemes that say what the test wants.
#include "solve/run/runner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace engrane {

using namespace solve;

namespace {

/// Converges where `works` says so and proposes `next` for the step after.
class Obedient final : public Scheme {
 public:
  using Scheme::Scheme;
  StartReport start(Configuration&) override { return {}; }
  Outcome attempt(const Configuration& from, double h, Configuration& to) override {
    tried.push_back(h);
    to = from;
    to.time = from.time + h;
    Outcome outcome;
    outcome.newton.converged = h <= longest;
    outcome.newton.reason = "too long";
    outcome.proposed = proposed;
    return outcome;
  }

  double longest = 1, proposed = 0;
  std::vector<double> tried;
};

class Runs : public testing::Test {
 protected:
  Runs() {
    model_.nodes.resize(1);
    options_.analysis = SolverOptions::Analysis::dynamics;
    options_.end = 2;
    options_.step = 1;
  }

  /// Ends of the accepted steps.
  std::vector<double> run(double longest, double proposed = 0) {
    SolverContext context(model_, options_, PETSC_COMM_SELF);
    Obedient scheme(context);
    scheme.longest = longest;
    scheme.proposed = proposed;
    std::vector<double> ends;
    Runner(context, scheme)
        .run(
            [&](const Configuration& c, const StepReport& step) {
              if (step.number > 0) ends.push_back(c.time);
              return true;
            },
            [](const StartReport&) {});
    tried_ = scheme.tried;
    return ends;
  }

  Model model_;
  SolverOptions options_;
  std::vector<double> tried_;
};

TEST_F(Runs, CutsAreADepth) {
  // steps of about 1/32, most of them after a failed try of twice their length: far more failures than 5 for each H
  const double longest = 1.1 / 32;  // steps of equal parts are some hundredths longer than halvings
  options_.cuts = 5;
  const std::vector<double> ends = run(longest);
  EXPECT_GE(ends.size(), 62U);
  EXPECT_EQ(ends.back(), 2);
  EXPECT_NE(std::find(ends.begin(), ends.end(), 1.0), ends.end()) << "the multiples of H are met";
  options_.cuts = 4;
  try {
    run(longest);
    FAIL() << "a depth of 4 does not reach 1/32";
  } catch (const SolutionFailure& failure) {
    EXPECT_NE(std::string(failure.what()).find("the step was cut 4 times"), std::string::npos) << failure.what();
  }
}

TEST_F(Runs, TakesTheStepThatTheSchemeProposes) {
  const std::vector<double> ends = run(1, 0.25);
  // the first is H; from then on quarters
  ASSERT_EQ(ends.size(), 5U);
  EXPECT_DOUBLE_EQ(ends[0], 1);
  for (std::size_t i = 1; i < 5; ++i) EXPECT_DOUBLE_EQ(ends[i], 1 + 0.25 * static_cast<double>(i));
  EXPECT_EQ(tried_.size(), 5U);
}

TEST_F(Runs, NeverStepsLongerThanAsked) {
  run(1, 5);
  for (const double h : tried_) EXPECT_LE(h, 1);
}

}  // namespace
}  // namespace engrane
