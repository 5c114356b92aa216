// SPDX-License-Identifier: BSD-3-Clause
// K, C and M of Radau's steps that are kept: for steps of any length, by phase between events, and over a restart.
#include "solve/schemes/kept_matrices.hpp"

#include <vector>

#include "run_deck.hpp"
#include "solve/schemes/collocation.hpp"

namespace engrane::test {
namespace {

constexpr const char* damped_pendulum = R"(
.NOE
 I 1 X 1 0 0
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1 AT 0 0 0
 I 2 INERTIA N 1 M 2 J 0.1 0.2 0.3
 I 3 TSPRING N 0 1 AXIS 0 0 1 K 50 C 3
.SAM TYPE DYNAMIC SCHEME RADAU SOLVER KLU
.SUB TF 1 H 0.01 TOL 1E-4
)";

class Bench {
 public:
  Bench() : run_(damped_pendulum), c_(run_.context().numbering.reference_configuration(0)) {
    assembler().choose_scale(c_, {1, 100, 1e4}, 0);
    for (Eigen::Index i = 0; i < collocation_.stages(); ++i) {
      *residuals_.emplace_back().out() = assembler().new_vector();
      *changes_.emplace_back().out() = assembler().new_vector();
    }
  }

  Assembler& assembler() { return run_.context().assembler; }
  const Configuration& c() const { return c_; }
  StageSolver solver() { return {assembler(), collocation_, "KLU"}; }
  /// What the systems of a solver make of some residuals.
  std::vector<double> changes(StageSolver& solver) {
    std::vector<double> all;
    for (std::size_t i = 0; i < residuals_.size(); ++i) check_petsc(VecSet(residuals_[i], 1 + static_cast<double>(i)));
    EXPECT_TRUE(solver.solve(residuals_, changes_));
    for (const Owned<Vec>& change : changes_) {
      const auto values = assembler().gather(change);
      all.insert(all.end(), values.begin(), values.end());
    }
    return all;
  }

 private:
  DeckRun run_;
  Configuration c_;
  Collocation collocation_ = Collocation::radau();
  std::vector<Owned<Vec>> residuals_, changes_;
};

TEST(KeptMatrices, ServeStepsOfAnyLength) {
  Bench bench;
  StageSolver one = bench.solver(), other = bench.solver();
  KeptMatrices kept(bench.assembler(), one), anew(bench.assembler(), other);
  EXPECT_FALSE(kept.recall(0.003));
  kept.evaluate(bench.c(), 0.01);
  const std::vector<double> first = bench.changes(one);
  ASSERT_TRUE(kept.recall(0.003));
  anew.evaluate(bench.c(), 0.003);
  EXPECT_EQ(bench.changes(one), bench.changes(other));
  EXPECT_NE(bench.changes(one), first);
}

TEST(KeptMatrices, AreFoundAgainInThePhaseThatTheyWereMadeIn) {
  Bench bench;
  StageSolver solver = bench.solver();
  KeptMatrices kept(bench.assembler(), solver);
  // apart, then together: known when the teeth come together from there again
  for (const int side : {1, -1, 1}) {
    kept.enter({side});
    EXPECT_FALSE(kept.recall(0.01));
    kept.evaluate(bench.c(), 0.01);
  }
  kept.enter({-1});
  EXPECT_TRUE(kept.recall(0.01));
  kept.step();
  EXPECT_FALSE(kept.recall(0.01));  // of the first step, not of the second
  kept.enter({1});
  EXPECT_TRUE(kept.recall(0.01));
  kept.drop();
  EXPECT_FALSE(kept.recall(0.01));
  kept.enter({-1});
  EXPECT_TRUE(kept.recall(0.01));
  // they belong to one scale of the multipliers
  bench.assembler().choose_scale(bench.c(), {1, 0, 1e8}, 0);
  EXPECT_FALSE(kept.recall(0.01));
}

TEST(KeptMatrices, AreTheSameAfterARestart) {
  Bench bench;
  StageSolver before = bench.solver(), after = bench.solver();
  KeptMatrices kept(bench.assembler(), before), restored(bench.assembler(), after);
  kept.enter({1, 0});
  kept.evaluate(bench.c(), 0.01);
  Snapshot snapshot;
  kept.save(snapshot);
  restored.load(snapshot);
  ASSERT_TRUE(kept.recall(0.02));
  ASSERT_TRUE(restored.recall(0.02));
  EXPECT_EQ(bench.changes(before), bench.changes(after));
}

}  // namespace
}  // namespace engrane::test
