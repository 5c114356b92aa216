// SPDX-License-Identifier: BSD-3-Clause
// The condition of a step's matrix must not grow as h → 0, which is what the scale k of the multipliers is for.
#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <string>

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
  DeckRun deck(double_pendulum + R"( I 5 SPRING N 1 2 K 100
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

/// The largest scale of a mean link on the corners of a square and a node this far beside its middle.
double largest_scale(double beside) {
  std::string text = ".NOE\n I 9 X 0 0 0\n I 1 X -1 -1 0\n I 2 X 1 -1 0\n I 3 X 1 1 0\n I 4 X -1 1 0\n";
  text += fmt::format(" I 5 X {} {} 0\n.MCE\n I 9 MEAN_LINK N 9 MEMBERS 1 2 3 4 5\n", beside, beside);
  for (int i = 1; i <= 5; ++i) text += fmt::format(" I {} INERTIA N {} M 1 J 1\n", 10 + i, i);
  DeckRun deck(text + ".SAM TYPE DYNAMIC\n.SUB TF 1 H 0.01\n");
  Assembler& assembler = deck.context().assembler;
  assembler.choose_scale(deck.context().numbering.reference_configuration(0), {1, 200, 4e4}, 0);
  return *std::max_element(assembler.scale().begin(), assembler.scale().end());
}

TEST(Scaling, ANodeWithoutALeverSaysNothingOfTheMoment) {
  const double centred = largest_scale(0);
  EXPECT_GT(centred, 1e4);
  for (const double beside : {1e-16, 1e-18, 1e-9}) EXPECT_NEAR(largest_scale(beside), centred, 1e-6 * centred);
}

TEST(Scaling, WithoutItTheConditionGrowsByTheFourthPower) {
  const auto plain = conditions(1);
  EXPECT_GT(plain.back() / plain.front(), 1e12) << "if this no longer grows, the test above judges nothing";
}

}  // namespace
}  // namespace engrane::test
