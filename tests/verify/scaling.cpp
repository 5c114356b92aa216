// SPDX-License-Identifier: BSD-3-Clause
// The condition of a step's matrix must not grow as h → 0, which is what the scale k of the multipliers is for.
#include <Eigen/Dense>

#include "dense_matrix.hpp"
#include "run_deck.hpp"

namespace engrane::test {
namespace {

double condition(const Assembler& assembler) {
  const Eigen::VectorXd sizes = Eigen::JacobiSVD<Eigen::MatrixXd>(dense(assembler)).singularValues();
  return sizes[0] / sizes[sizes.size() - 1];
}

/// Conditions of the matrix of a first step for h = 1e-2 … 1e-8; `fixed` 0 lets the assembler choose k.
std::vector<double> conditions(double fixed) {
  DeckRun deck(R"(
.NOE
 I 1 X 1 0 0
 I 2 X 2 0.5 0.3
.MCE
 I 1 HINGE N 0 1 AXIS 0 1 1 AT 0 0 0
 I 2 HINGE N 1 2 AXIS 1 0 2 AT 1.5 0.2 0.1
 I 3 INERTIA N 1 M 1 J 0.1 0.3 0.3
 I 4 INERTIA N 2 M 2 J 0.2 0.1 0.2
 I 5 SPRING N 1 2 K 100
.SAM TYPE DYNAMIC
.SUB TF 1 H 0.01
)");
  Assembler& assembler = deck.context().assembler;
  const Configuration c = deck.context().numbering.reference_configuration(0);
  std::vector<double> found;
  for (double h = 1e-2; h > 0.5e-8; h /= 100) {
    const Weights weights{1, 2 / h, 4 / (h * h)};
    assembler.choose_scale(c, weights, fixed);
    assembler.tangent(c, weights);
    found.push_back(condition(assembler));
  }
  return found;
}

TEST(Scaling, ConditionDoesNotGrowAsTheStepShrinks) {
  const auto chosen = conditions(0);
  for (const double value : chosen) EXPECT_LT(value, 3 * chosen.front());
  EXPECT_LT(chosen.back(), 1e5);
}

TEST(Scaling, WithoutItTheConditionGrowsByTheFourthPower) {
  const auto plain = conditions(1);
  EXPECT_GT(plain.back() / plain.front(), 1e12) << "if this no longer grows, the test above judges nothing";
}

}  // namespace
}  // namespace engrane::test
