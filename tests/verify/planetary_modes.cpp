// SPDX-License-Identifier: BSD-3-Clause
// Natural frequencies of a planetary set from the linearised model, against Lin and Parker (1999).
#include <fmt/format.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "dense_matrix.hpp"
#include "run_deck.hpp"

namespace engrane::test {
namespace {

/// Their example: I/r² of the table, on wheels of another size that fit together, which changes nothing: displacements
/// count along lines of action. Mesh stiffness 5e8 along the line of action is 5e8 cos²α along the circumference.
std::string planetary() {
  constexpr double module = 0.003, alpha = 24.6 * std::numbers::pi / 180;
  const double c = std::cos(alpha), r_s = 12 * module, r_p = 9 * module, r_r = 30 * module, r_c = r_s + r_p;
  const auto inertia = [&](double per_square, double radius) { return per_square * radius * radius; };
  std::string deck = fmt::format(
      R"(.NOE
 I 1 X 0 0 0
 I 2 X 0 0 0
 I 3 X 0 0 0
.MCE
 I 1 INERTIA N 1 M 0.4 J 1 1 {}
 I 2 INERTIA N 2 M 2.35 J 1 1 {}
 I 3 INERTIA N 3 M 5.43 J 1 1 {}
 I 4 SPRING N 0 1 K 1D8 1D8 0
 I 5 SPRING N 0 2 K 1D8 1D8 0
 I 6 SPRING N 0 3 K 1D8 1D8 0
 I 7 TSPRING N 0 2 AXIS 0 0 1 K {}
)",
      inertia(0.39, r_s * c), inertia(3.0, r_r * c), inertia(6.29, r_c), 1e9 * r_r * r_r * c * c);
  for (int i = 0; i < 3; ++i) {
    const double angle = i * 2 * std::numbers::pi / 3;
    deck += fmt::format(R"(.NOE
 I {0} X {2:.17g} {3:.17g} 0
 I {1} X {2:.17g} {3:.17g} 0
.MCE
 I {0} INERTIA N {0} M 0.66 J 1 1 {4}
 I {1} RIGID N 3 {1}
 I {5} SPRING N {1} {0} K 1D8 1D8 0
 I {6} GEAR N 1 {0} AXIS 0 0 1 Z 24 18 MN 0.003 ALPHA 24.6 KM {8:.17g} JEU 1D-5 SMOOTH 0 RUNNING
 I {7} GEAR N {0} 2 AXIS 0 0 1 Z 18 60 MN 0.003 ALPHA 24.6 INTERNAL KM {8:.17g} JEU 1D-5 SMOOTH 0 RUNNING
)",
                        11 + i, 21 + i, r_c * std::cos(angle), r_c * std::sin(angle), inertia(0.61, r_p * c), 31 + i, 41 + i,
                        51 + i, 5e8 * c * c);
  }
  return deck + R"(.CLM
 FIX NOEUD 1 2 3 11 12 13 21 22 23 C 3 4 5
.SAM TYPE DYNAMIC
.SUB TF 1 H 0.1
)";
}

TEST(PlanetaryModes, FrequenciesOfLinAndParker) {
  DeckRun deck(planetary());
  Assembler& assembler = deck.context().assembler;
  const Numbering& numbering = deck.context().numbering;
  Configuration state = numbering.reference_configuration(0);
  // just touching, no load, so no stiffness but that of springs and teeth; the sun drives in the positive sense, so the
  // planets press the ring with their other flanks
  for (std::size_t p = 0; p < deck.model().parts.size(); ++p) {
    const Element& element = *deck.model().parts[p].element;
    if (element.layout().scalars.size() != 3) continue;
    const double touching = element.id() > 50 ? -1e-5 - 1e-12 : 1e-12;
    state.scalars[static_cast<std::size_t>(numbering.scalar_begin(static_cast<int>(p)) + 2)] = touching;
  }
  assembler.tangent(state, {1, 0, 0});
  const Eigen::MatrixXd all_K = dense(assembler);
  assembler.tangent(state, {0, 0, 1});
  const Eigen::MatrixXd all_M = dense(assembler);

  // the motions that the constraints allow: wheels and carrier, since ψ, u_m and the pins follow them
  std::vector<int> motion, closed;
  for (int i = 0; i < numbering.equations(); ++i) (numbering.unknown(i).multiplier ? closed : motion).push_back(i);
  const Eigen::MatrixXd K = all_K(motion, motion), M = all_M(motion, motion), B = all_K(closed, motion);
  const Eigen::MatrixXd allowed = Eigen::FullPivLU<Eigen::MatrixXd>(B).kernel();
  const Eigen::MatrixXd k = allowed.transpose() * K * allowed, m = allowed.transpose() * M * allowed;
  EXPECT_LT((k - k.transpose()).norm(), 1e-10 * k.norm());
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(k, m);
  std::vector<double> found;
  for (const double square : modes.eigenvalues()) found.push_back(std::sqrt(std::max(0.0, square)) / (2 * std::numbers::pi));
  // references of Lin and Parker (1999), solved to these digits from their matrices (tests/verify/oracles/planetary.py);
  // translational modes come in pairs
  const std::vector<double> expected{0,         743.1639,  743.1639,  1102.4193, 1102.4193, 1475.7472,
                                     1896.0199, 1896.0199, 1930.3466, 2276.3801, 2276.3801, 2658.3244,
                                     6986.2982, 6986.2982, 7462.8034, 9647.9132, 9647.9132, 11775.2658};
  ASSERT_EQ(found.size(), expected.size());
  EXPECT_LT(found[0], 1);
  for (std::size_t i = 1; i < expected.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-4 + 2e-8 * expected[i]) << i;
}

}  // namespace
}  // namespace engrane::test
