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

/// Converges up to a length of step, with an error that grows with the square of the step and is 1 at `fine`.
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
    if (context_.options.tolerance > 0) outcome.error = std::pow(h / (from.time < 1 ? fine : finer), 2);
    return outcome;
  }

  int order_of_error() const override { return 2; }

  double longest = 1, fine = 1, finer = 1;  ///< the last from t = 1 on
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
  std::vector<double> run(double longest, double fine = 1, double finer = 1) {
    SolverContext context(model_, options_, PETSC_COMM_SELF);
    Obedient scheme(context);
    scheme.longest = longest;
    scheme.fine = fine;
    scheme.finer = finer;
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

TEST_F(Runs, StepsFollowTheirError) {
  options_.tolerance = 1e-3;
  options_.step = 0.001;
  options_.longest = 0.5;
  const std::vector<double> ends = run(1, 0.1, 0.02);
  EXPECT_EQ(ends.back(), 2);
  // they double from H to where their error is a little below the tolerance, and stay
  EXPECT_DOUBLE_EQ(tried_[0], 0.001);
  EXPECT_DOUBLE_EQ(tried_[1], 0.002);
  std::vector<double> steps;
  for (std::size_t i = 1; i < ends.size(); ++i) steps.push_back(ends[i] - ends[i - 1]);
  for (std::size_t i = 0; i < steps.size(); ++i)
    EXPECT_LE(steps[i], (ends[i] < 1 ? 0.1 : 0.02) * (1 + 1e-9)) << "a step stands whose error is above the tolerance";
  EXPECT_GT(steps[15], 0.07);
  EXPECT_NEAR(steps[12], steps[13], 1e-12) << "steps that would change little stay";
  EXPECT_GT(steps[steps.size() - 10], 0.014);
  // where the error grows 25 times, few attempts fail
  EXPECT_LE(tried_.size(), ends.size() + 3);
}

TEST_F(Runs, StepsAreNoLongerThanTheLongest) {
  options_.tolerance = 1e-3;
  options_.step = 0.1;
  options_.longest = 0.25;
  run(1, 100, 100);
  for (const double h : tried_) EXPECT_LE(h, 0.25);
  EXPECT_EQ(std::count(tried_.begin(), tried_.end(), 0.25), 5) << tried_.size();
}

TEST_F(Runs, AnErrorThatDoesNotFallEndsTheRun) {
  options_.tolerance = 1e-3;
  options_.longest = 1;
  try {
    run(1, 1e-30);
    FAIL() << "no step is short enough";
  } catch (const SolutionFailure& failure) {
    EXPECT_NE(std::string(failure.what()).find("times the tolerance TOL"), std::string::npos) << failure.what();
  }
}

}  // namespace
}  // namespace engrane
