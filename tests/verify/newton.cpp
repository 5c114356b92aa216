// SPDX-License-Identifier: BSD-3-Clause
// Newton's method must be quadratic: an inexact tangent would show here before anywhere else.
#include <cmath>
#include <string>
#include <vector>

#include "run_deck.hpp"

namespace engrane::test {
namespace {

double largest(const NewtonRow& row) { return std::max({row.force, row.moment, row.length, row.angle}); }

/// Order p of e₂ ~ e₁^p from three successive residuals, the last of which must be clear of rounding.
double order(const NewtonRow& a, const NewtonRow& b, const NewtonRow& c) {
  return std::log(largest(c) / largest(b)) / std::log(largest(b) / largest(a));
}

const char* const bevel = R"(
.NOE
 I 1 X 0 0 0
 I 2 X 0 1 5
 I 3 X 0 1 5
 I 4 X 0 1 0
.MCE
 I 1 GEAR N 1 2 AXIS 0 1 0 Z 50 10 MN 0.2 ALPHA 20 CONE (-atan(5)*180/PI) (-atan(0.2)*180/PI)
 I 2 RIGID N 4 3
 I 3 HINGE N 3 2 AXIS 0 0 -1
 I 4 HINGE N 0 4 AXIS 0 1 0 DRIVE NF 1
 I 5 TORQUE N 3 2 AXIS 0 0 -1 V 1000
.FCT
 I 1 TABLE 0 0 1 1
.CLM
 FIX NOEUD 1 C 1 2 3 4 5 6
.SAM TYPE STATIC
.SUB TF 1 H 0.25
)";

TEST(Newton, IsQuadraticOnTheBevelPair) {
  DeckRun deck(bevel);
  int judged = 0;
  deck.run([&](const Configuration&, const StepReport& step) {
    if (!step.newton) return;
    const auto& rows = step.newton->rows;
    for (std::size_t i = 2; i < rows.size(); ++i) {
      if (largest(rows[i - 2]) > 2e-2 || largest(rows[i]) < 1e-13) continue;
      EXPECT_GT(order(rows[i - 2], rows[i - 1], rows[i]), 1.7) << "step " << step.number << ", iteration " << i;
      ++judged;
    }
  });
  EXPECT_GE(judged, 3) << "no step had three residuals between 2e-2 and rounding: the test judged nothing";
}

TEST(Newton, IsQuadraticInDynamicsAtLargeSteps) {
  DeckRun deck(double_pendulum + R"(.CLM
 STRU ACC VAL 0 0 -9.81
.INI
 VIT NOEUD 2 C 4 V 6
.SAM TYPE DYNAMIC RHO 0.8 PREC 1e-12 TANGENT FULL
.SUB TF 1 H 0.05
)");
  int judged = 0;
  deck.run([&](const Configuration&, const StepReport& step) {
    if (!step.newton) return;
    const auto& rows = step.newton->rows;
    // predictions may be lucky: the square of one residual bounds the next, whatever came before. A tangent that is wrong by a
    // thousandth leaves a hundred times as much of 1e-5.
    for (std::size_t i = 1; i < rows.size(); ++i) {
      const double before = largest(rows[i - 1]), after = largest(rows[i]);
      if (before > 0.5 || before < 1e-6) continue;
      EXPECT_LE(after, 10 * before * before) << "step " << step.number << ", iteration " << i;
      judged += before < 1e-3;
    }
  });
  EXPECT_GE(judged, 5);
}

/// Steps of Radau IIA too long for one tangent of all stages are solved with those of each. This top turns by a radian in a
/// step: tangents that leave out how velocities depend on rotations reduce corrections to 0.4.
TEST(Newton, IsQuadraticOnTheStagesOfLongSteps) {
  DeckRun deck("INPUT \"" ENGRANE_SOURCE_DIR
               "/tests/verify/tumbling_top.dat\"\n"
               ".SAM TYPE DYNAMIC SCHEME RADAU PREC 1e-12\n.SUB TF 0.07 H 0.007\n");
  int judged = 0;
  deck.run([&](const Configuration&, const StepReport& step) {
    if (!step.newton || !step.newton->coupled) return;
    EXPECT_EQ(step.cuts, 0) << "step " << step.number;
    const auto& rows = step.newton->rows;
    for (std::size_t i = 2; i < rows.size(); ++i) {
      if (rows[i].correction < 1e-12) continue;
      EXPECT_LE(rows[i].correction, 10 * rows[i - 1].correction * rows[i - 1].correction) << "step " << step.number;
      ++judged;
    }
  });
  EXPECT_GE(judged, 5);
}

/// Twenty bars that fall, joined by hinges about two axes in turn.
std::string chain(const std::string& newton) {
  std::string nodes = ".NOE\n", parts = ".MCE\n";
  for (int i = 1; i <= 20; ++i) {
    nodes += " I " + std::to_string(i) + " X " + std::to_string(i - 0.5) + "\n";
    parts += " I " + std::to_string(i) + " INERTIA N " + std::to_string(i) + " M 1 J 0.001 0.084 0.084\n";
    parts += " I " + std::to_string(20 + i) + " HINGE N " + std::to_string(i - 1) + " " + std::to_string(i) +
             (i % 2 ? " AXIS 0 1 0 AT " : " AXIS 0 0.6 0.8 AT ") + std::to_string(i - 1) + " 0 0\n";
  }
  return nodes + parts + ".CLM\n STRU ACC VAL 0 0 -9.81\n.SAM TYPE DYNAMIC RHO 0.8 SOLVER KLU TANGENT " + newton +
         "\n.SUB TF 0.2 H 0.001\n";
}

TEST(Newton, KeepsFactorsWithoutLosingDigits) {
  std::vector<double> ends[2];
  int iterations[2] = {0, 0};
  const char* const kinds[2] = {"FULL", "KEPT"};
  for (int kind = 0; kind < 2; ++kind) {
    DeckRun deck(chain(kinds[kind]));
    deck.run([&](const Configuration& c, const StepReport& step) {
      if (!step.newton) return;
      iterations[kind] += step.newton->iterations;
      // the worst residual that a step ends with is what PREC asks for
      EXPECT_LE(largest(step.newton->rows.back()), 1e-9) << kinds[kind] << ", step " << step.number;
      ends[kind] = c.multipliers;
    });
  }
  double worst = 0, size = 0;
  for (std::size_t m = 0; m < ends[0].size(); ++m) {
    worst = std::max(worst, std::abs(ends[0][m] - ends[1][m]));
    size = std::max(size, std::abs(ends[0][m]));
  }
  EXPECT_LE(worst, 1e-7 * size);
  // linear convergence shows in more iterations; quadratic predictions leave few of them
  EXPECT_GT(iterations[1], iterations[0]);
  EXPECT_LT(iterations[1], 3 * iterations[0]);
}

/// A rotor with a rigid shaft on springs that stand still, and so turn once a revolution in its axes. Factors that did not turn
/// with it would serve 1.7 degrees each, with 4.4 corrections a step.
TEST(Newton, KeptFactorsTurnWithAShaft) {
  DeckRun deck(R"(
.NOE
 I 1 X 0 0 0
 I 2 X 0 0 0.5
 I 3 X 0 0 0.2
.MCE
 I 1 RIGID N 3 1 2
 I 2 INERTIA N 3 M 10 J 0.2 0.2 0.3
 I 3 SPRING N 0 1 K 1E5 AT 1 0 0
 I 4 SPRING N 0 1 K 2E5 AT 0 1 0
 I 5 SPRING N 0 2 K 1E5 AT 1 0 0.5
 I 6 SPRING N 0 2 K 2E5 AT 0 1 0.5
 I 7 SPRING N 0 1 K 1E5 AT 0 0 -1
.INI
 VIT NOEUD 3 C 6 V 60
.CLM
 STRU ACC VAL 3 -9.81 1
.SAM TYPE DYNAMIC SOLVER KLU TANGENT KEPT
.SUB TF 0.4 H 5E-4
)");
  int steps = 0, iterations = 0, tangents = 0;
  long changes = 0;
  deck.run([&](const Configuration&, const StepReport& step) {
    const long now = deck.context().assembler.changes();
    if (step.number > 100) {
      ++steps;
      iterations += step.newton->iterations;
      tangents += now != changes;
    }
    changes = now;
  });
  EXPECT_EQ(steps, 700);
  EXPECT_LT(iterations, 2.2 * steps);
  EXPECT_LT(tangents, 90);  // in 21 rad
}

// No load arrives at a node inside an element: rounding there would never fall below a part of itself, and whether a run
// converged would depend on the order in which the processor adds.
TEST(Newton, ANodeInsideAnElementIsJudgedByItsEnds) {
  DeckRun run(
      ".NOE\n I 1 X 0 0 0\n I 2 X 1 0 0\n I 3 X 2 0 0\n.BPR\n I 1 EA 1E6 GA 1E6 1E6 GJ 1E4 EI 1E4 1E4\n"
      ".MCE\n I 1 BEAM N 1 2 3 BPR 1\n.CLM\n FIX NOEUD 1 C 1 2 3 4 5 6\n.SAM TYPE STATIC\n.FIN 1\n");
  const Assembler& assembler = run.context().assembler;
  References references(assembler, 1e-9);
  const Configuration c = assembler.numbering().reference_configuration(0);
  std::vector<double> carried(static_cast<std::size_t>(assembler.numbering().equations()), 0.0);
  const auto equation = [&](int node, int k) { return assembler.numbering().equation(6 * run.model().node_index(node) + k); };
  carried[static_cast<std::size_t>(equation(3, 1))] = 7;
  carried[static_cast<std::size_t>(equation(3, 4))] = 20;
  references.begin(c);
  references.take(c, carried);
  for (const int k : {0, 1, 2}) EXPECT_EQ(references.load(equation(2, k)), 7) << k;
  for (const int k : {3, 4, 5}) EXPECT_EQ(references.load(equation(2, k)), 20) << k;
}

TEST(Newton, ReportsTheFreeMotionOfASingularModel) {
  DeckRun deck(R"(
.NOE
 I 1 X 0 0 0
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1
 I 2 TORQUE N 0 1 AXIS 0 0 1 V 1
.SAM TYPE STATIC
.SUB TF 1 H 1
)");
  try {
    deck.run();
    FAIL() << "a free hinge has no equilibrium under a torque";
  } catch (const SolutionFailure& failure) {
    EXPECT_NE(std::string(failure.what()).find("node 1 (rz)"), std::string::npos) << failure.what();
  }
}

}  // namespace
}  // namespace engrane::test
