// SPDX-License-Identifier: BSD-3-Clause
// Elements' residuals and tangents in PETSc's vector and matrix, against sums made entry by entry.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "springs.hpp"

namespace engrane::test {
namespace {

Eigen::MatrixXd dense(Mat matrix) {
  PetscInt rows = 0;
  check_petsc(MatGetSize(matrix, &rows, nullptr));
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(rows, rows);
  for (PetscInt i = 0; i < rows; ++i) {
    PetscInt count = 0;
    const PetscInt* columns = nullptr;
    const PetscScalar* values = nullptr;
    check_petsc(MatGetRow(matrix, i, &count, &columns, &values));
    for (PetscInt c = 0; c < count; ++c) all(i, columns[c]) = values[c];
    check_petsc(MatRestoreRow(matrix, i, &count, &columns, &values));
  }
  return all;
}

std::vector<double> values_of(Vec vector) {
  PetscInt n = 0;
  check_petsc(VecGetLocalSize(vector, &n));
  const PetscScalar* values = nullptr;
  check_petsc(VecGetArrayRead(vector, &values));
  std::vector<double> all(values, values + n);
  check_petsc(VecRestoreArrayRead(vector, &values));
  return all;
}

struct System {
  explicit System(Model m, bool half = false)
      : model(std::move(m)), numbering(model), assembler(model, numbering, PETSC_COMM_SELF, half), state(shaken(numbering)) {}
  Model model;
  Numbering numbering;
  Assembler assembler;
  Configuration state;

  std::vector<double> residual() {
    Owned<Vec> r;
    *r.out() = assembler.new_vector();
    assembler.residual(state, r);
    return values_of(r);
  }
  Eigen::MatrixXd tangent(Weights weights) {
    assembler.tangent(state, weights);
    return dense(assembler.matrix());
  }
  /// The same, element by element into a dense matrix.
  Eigen::MatrixXd expected_tangent(Weights weights) const {
    const int equations = numbering.equations(), motion = numbering.motion_slots();
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(equations, equations);
    for (int p = 0; p < numbering.parts(); ++p) {
      const auto slots = numbering.part_slots(p);
      const std::size_t n = slots.size();
      std::vector<double> r(n), k(n * n);
      model.parts[static_cast<std::size_t>(p)].element->tangent(assembler.view(p, state), weights, r, k);
      const auto factor = [&](int slot) {
        return slot < motion ? 1.0 : assembler.scale()[static_cast<std::size_t>(slot - motion)];
      };
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) {
          const int row = numbering.equation(slots[i]), column = numbering.equation(slots[j]);
          const bool held = slots[i] >= motion && assembler.released(slots[i] - motion);
          if (row >= 0 && column >= 0 && !held) all(row, column) += k[i * n + j] * factor(slots[i]) * factor(slots[j]);
        }
    }
    for (int m = 0; m < numbering.slots() - motion; ++m)
      if (assembler.released(m))
        all(numbering.equation(motion + m), numbering.equation(motion + m)) -= assembler.scale()[static_cast<std::size_t>(m)];
    return all;
  }
};

constexpr Weights step_weights{1, 20, 400};

TEST(Scatter, TangentIsTheSumOfTheElements) {
  System system(row_of_masses(11, true, true));
  system.assembler.choose_scale(system.state, step_weights, 0);
  const Eigen::MatrixXd expected = system.expected_tangent(step_weights);
  EXPECT_LE((system.tangent(step_weights) - expected).cwiseAbs().maxCoeff(), 1e-15 * expected.cwiseAbs().maxCoeff());
  EXPECT_GT(expected.cwiseAbs().maxCoeff(), 400);
}

TEST(Scatter, ForgottenPlacesAreFoundAgain) {
  System system(row_of_masses(11, true, true));
  const Eigen::MatrixXd before = system.tangent(step_weights);
  system.assembler.forget_places();
  system.state = shaken(system.numbering);
  EXPECT_EQ(system.tangent(step_weights), before);
}

TEST(Scatter, AHalfIsTheWholeFromTheDiagonalOn) {
  for (const bool in_turn : {false, true}) {
    System whole(row_of_masses(11, true, in_turn)), half(row_of_masses(11, true, in_turn), true);
    const Eigen::MatrixXd upper = whole.tangent(step_weights).triangularView<Eigen::Upper>();
    EXPECT_EQ(half.tangent(step_weights), upper);
    half.assembler.forget_places();
    EXPECT_EQ(half.tangent(step_weights), upper);
  }
}

TEST(Scatter, HeldComponentsAreLeftOut) {
  Model model = row_of_masses(7, true, true);
  model.supports = {{2, 1, 0, nullptr}, {3, 0, 0, nullptr}, {3, 4, 0, nullptr}};
  System system(std::move(model));
  EXPECT_EQ(system.numbering.equations(), 7 * 3 + 2 * 5 - 3);
  const Eigen::MatrixXd expected = system.expected_tangent(step_weights);
  EXPECT_LE((system.tangent(step_weights) - expected).cwiseAbs().maxCoeff(), 1e-15 * expected.cwiseAbs().maxCoeff());
}

TEST(Scatter, AReleasedConstraintKeepsItsColumnAndAsksForItsValue) {
  System system(row_of_masses(6, false, true));
  system.assembler.choose_scale(system.state, step_weights, 7);
  system.assembler.release({1}, {0, 3.5});
  const Eigen::MatrixXd expected = system.expected_tangent(step_weights);
  EXPECT_LE((system.tangent(step_weights) - expected).cwiseAbs().maxCoeff(), 1e-15 * expected.cwiseAbs().maxCoeff());
  const int row = system.numbering.equation(system.numbering.motion_slots() + 1);
  EXPECT_DOUBLE_EQ(system.residual()[static_cast<std::size_t>(row)], 3.5 - system.state.multipliers[1]);
}

TEST(Scatter, PartsOfTheTangentApartInAMatrixOfTheCallers) {
  System system(row_of_masses(5, true, false));
  Owned<Mat> k, c, m, b;
  for (auto& [matrix, weights] :
       {std::pair<Owned<Mat>*, Weights>{&k, {1, 0, 0, 0}}, {&c, {0, 1, 0, 0}}, {&m, {0, 0, 1, 0}}, {&b, {0, 0, 0, 1}}}) {
    *matrix->out() = system.assembler.new_matrix();
    system.assembler.tangent(system.state, weights, *matrix);
  }
  const Eigen::MatrixXd whole = system.tangent({0.5, 20, 400, 2}),
                        sum = 0.5 * dense(k) + 20 * dense(c) + 400 * dense(m) + 2 * dense(b);
  EXPECT_LE((whole - sum).cwiseAbs().maxCoeff(), 1e-14 * whole.cwiseAbs().maxCoeff());
  EXPECT_GT(dense(m).diagonal().head(3).minCoeff(), 1) << "the mass matrix has the masses";
  EXPECT_EQ(dense(m)(0, 3), 0) << "and no springs";
}

TEST(Scatter, ABlockGivesTheBitsOfLoneElements) {
  for (const bool in_turn : {false, true}) {
    System alone(row_of_masses(200, false, in_turn)), block(row_of_masses(200, true, in_turn));
    EXPECT_EQ(alone.residual(), block.residual());
    EXPECT_EQ(alone.tangent(step_weights), block.tangent(step_weights));
  }
}

TEST(Scatter, OrderOfTheElementsChangesNothingButRounding) {
  System turn(row_of_masses(90, true, true)), last(row_of_masses(90, true, false));
  const Eigen::MatrixXd a = turn.expected_tangent(step_weights), b = last.tangent(step_weights);
  // own unknowns are numbered in the order of the elements, which is the same for the masses
  EXPECT_LE((a - b).cwiseAbs().maxCoeff(), 1e-15 * a.cwiseAbs().maxCoeff());
}

TEST(Scatter, AHeldEquationOfAProjectionHardlyMoves) {
  System system(row_of_masses(4, true, true));
  const std::vector<int> held = {5, 2};
  system.assembler.projection(system.state, Assembler::Metric::mass, held);
  const Eigen::MatrixXd m = dense(system.assembler.matrix());
  for (const int e : held) EXPECT_GT(m(e, e), 0.9e8);
  EXPECT_LT(m(0, 0), 2);
}

TEST(Assembler, TurnsAreCountedWithoutWhatAnAcceptedStepWrites) {
  System system(row_of_masses(6, true, true));
  ASSERT_EQ(system.state.history.size(), 2u);
  system.assembler.count_turns(system.state);
  EXPECT_EQ(system.state.history, (std::vector<double>{1, 1}));
  system.assembler.commit(system.state);
  EXPECT_EQ(system.state.history, (std::vector<double>{102, 102}));
}

TEST(Assembler, TheLengthOfTheStepReachesTheElements) {
  System system(row_of_masses(3, true, true));
  const auto with = system.residual();
  system.state.h = 0;
  EXPECT_NE(with, system.residual());
}

TEST(Layout, SlotsAreThoseThatAreAskedFor) {
  Layout layout;
  layout.nodes = {4, 5, 6};
  layout.needs = {NodeNeed::translation, NodeNeed::rotation, NodeNeed::both};
  layout.scalars = {{"S", dimension::length, ""}};
  layout.multipliers = {{"L", dimension::length, ""}};
  EXPECT_EQ(layout.node_slot(0, NodeNeed::translation), 0);
  EXPECT_EQ(layout.node_slot(0, NodeNeed::rotation), -1);
  EXPECT_EQ(layout.node_slot(1, NodeNeed::translation), -1);
  EXPECT_EQ(layout.node_slot(1, NodeNeed::rotation), 3);
  EXPECT_EQ(layout.node_slot(2, NodeNeed::translation), 6);
  EXPECT_EQ(layout.node_slot(2, NodeNeed::rotation), 9);
  EXPECT_EQ(layout.node_slots(), 12);
  EXPECT_EQ(layout.slots(), 14);
}

TEST(Field, CountsItsNumbers) {
  const Field stress{{"STRESS", dimension::force, "in the plane"}, Field::Place::point, {"XX", "YY", "XY"}, 4};
  EXPECT_EQ(stress.size(8), 12u);
  const Field temperature{{"T", dimension::none, ""}, Field::Place::node};
  EXPECT_EQ(temperature.size(8), 8u);
  const Field energy{{"E", dimension::energy, ""}};
  EXPECT_EQ(energy.size(8), 1u);
}

}  // namespace
}  // namespace engrane::test
