// SPDX-License-Identifier: BSD-3-Clause
#include "solve/algebra/factor_policy.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace engrane::solve {
namespace {

constexpr double renewal = 7;   ///< cost of new factors, in corrections
constexpr double begins = 1e5;  ///< residual of a prediction, over what it is to become

/// A machine on which corrections with factors of `age` solutions leave a part θ = `growth` · age of the residual.
struct Machine {
  double growth;
  double contraction(int age) const { return std::max(1e-6, growth * age); }
};

/// Cost of a solution when the policy decides; `age` is that of the factors.
double solve(FactorPolicy& policy, const Machine& machine, int& age) {
  double residual = begins, cost = 0;
  ++age;
  policy.begin(residual, renewal);
  while (residual > 1) {
    if (policy.due()) {
      policy.renewed();
      age = 0;
      cost += renewal;
    }
    residual *= machine.contraction(age);
    policy.corrected(residual);
    cost += 1;
    if (cost > 1000) break;
  }
  policy.end(true);
  return cost;
}

/// Mean cost when factors are renewed every `period` solutions.
double periodic(const Machine& machine, int period) {
  double cost = renewal;
  for (int age = 0; age < period; ++age)
    for (double residual = begins; residual > 1; residual *= machine.contraction(age)) cost += 1;
  return cost / period;
}

TEST(FactorPolicy, CostsNoMoreThanTheBestPeriod) {
  for (const double growth : {1e-5, 1e-3, 0.004, 0.02, 0.08, 0.3}) {
    const Machine machine{growth};
    FactorPolicy policy;
    int age = 0;
    double cost = 0;
    constexpr int solutions = 3000;
    for (int i = 0; i < solutions; ++i) cost += solve(policy, machine, age);
    double best = periodic(machine, 1);
    // a contraction of one half is left alone by nobody
    for (int period = 2; period <= solutions && machine.contraction(period) < 0.5; ++period)
      best = std::min(best, periodic(machine, period));
    // what it costs to try factors that age fast, once each time, is at most one correction of eight
    EXPECT_LE(cost / solutions, 1.125 * best) << "growth " << growth;
  }
}

TEST(FactorPolicy, RenewsAtOnceWhereTheOldFactorsLeadNowhere) {
  FactorPolicy policy;
  int age = 0;
  for (int i = 0; i < 5; ++i) solve(policy, {1e-3}, age);
  policy.begin(begins, renewal);
  ASSERT_FALSE(policy.due());
  policy.corrected(0.9 * begins);  // a tooth has made contact, say
  EXPECT_TRUE(policy.due());
}

TEST(FactorPolicy, RenewsAfterAFailureAndForAnotherMatrix) {
  FactorPolicy policy;
  EXPECT_TRUE(policy.due());
  int age = 0;
  solve(policy, {1e-3}, age);
  policy.begin(begins, renewal);
  EXPECT_FALSE(policy.due());
  policy.end(false);
  policy.begin(begins, renewal);
  EXPECT_TRUE(policy.due());
  solve(policy, {1e-3}, age);
  policy.forget();
  policy.begin(begins, renewal);
  EXPECT_TRUE(policy.due());
}

TEST(FactorPolicy, GoesOnFromASnapshotAsItWould) {
  const Machine machine{0.01};
  FactorPolicy policy;
  int age = 0;
  for (int i = 0; i < 7; ++i) solve(policy, machine, age);
  Snapshot snapshot;
  policy.save(snapshot);
  FactorPolicy resumed;
  resumed.load(snapshot);
  int resumed_age = age;
  for (int i = 0; i < 100; ++i) {
    ASSERT_EQ(solve(policy, machine, age), solve(resumed, machine, resumed_age)) << "solution " << i;
    ASSERT_EQ(age, resumed_age);
  }
}

}  // namespace
}  // namespace engrane::solve
