// SPDX-License-Identifier: BSD-3-Clause
#include "elements/structural/cell.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <map>
#include <numbers>

#include "elements/structural/cell_topology.hpp"
#include "elements/structural/plane_cells.hpp"
#include "math/rotation.hpp"

namespace engrane::elements::structural::plane_cells {
namespace {

/// Area, or volume round the axis, by Gauss points enough for curved sides: of the polygon of many points on the sides.
double area_of(const std::vector<Eigen::Vector2d>& x, bool axi) {
  const std::size_t corners = x.size() <= 4 ? x.size() : x.size() / 2;
  constexpr double root = 0.7745966692414834;
  double sum = 0;
  for (std::size_t side = 0; side < corners; ++side) {
    const Eigen::Vector2d a = x[side], b = x[(side + 1) % corners],
                          m = x.size() > corners ? x[corners + side] : Eigen::Vector2d((a + b) / 2);
    for (const auto& [s, w] : {std::pair(-root, 5.0 / 9), std::pair(0.0, 8.0 / 9), std::pair(root, 5.0 / 9)}) {
      const Eigen::Vector2d p = s * (s - 1) / 2 * a + s * (s + 1) / 2 * b + (1 - s * s) * m;
      const Eigen::Vector2d t = (s - 0.5) * a + (s + 0.5) * b - 2 * s * m;
      // Green: the area is the integral of x dy, the first moment that of x²/2 dy
      sum += w * (axi ? std::numbers::pi * p[0] * p[0] : p[0]) * t[1];
    }
  }
  return sum;
}

/// A cell whose nodes have temperatures of their own, which vary with time.
std::unique_ptr<Element> warm_cell(const std::vector<Eigen::Vector2d>& places, const std::shared_ptr<const CellSection>& of) {
  static const Wave wave(0.3, 0.7, 1.9, 0.4);
  CellPlan plan = plan_of(places, of);
  std::vector<Warmth> warmth;
  for (std::size_t i = 0; i < places.size(); ++i) warmth.push_back({20 + 3 * static_cast<double>(i), &wave});
  plan.warmth = std::make_shared<const std::vector<Warmth>>(warmth);
  return make_plane_cell(plan, nullptr);
}

Subject subject(std::size_t count, Hypothesis hypothesis, Kind kind) {
  const bool axi = hypothesis == Hypothesis::axisymmetric;
  Subject s;
  s.name = name_of(count, hypothesis, kind);
  s.nodes = node_map(distorted(count));
  s.in_plane = true;
  s.length = 0.06;  // a cell of four nodes finds its modes for strains of this size
  s.step = 1e-2;
  s.build = [=](const Mat3& Q) {
    auto places = distorted(count);
    for (Eigen::Vector2d& x : places) x = (Q * Vec3(x[0], x[1], 0)).head<2>();
    return kind.warm ? warm_cell(places, section(hypothesis, kind)) : cell(places, section(hypothesis, kind));
  };
  s.mass = density * (axi ? 1 : thickness) * area_of(distorted(count), axi);
  s.skip[Check::equilibrium] = "inertia and weight are outer forces";
  if (kind.damping > 0) s.skip[Check::lagrange] = "a damper has no potential";
  if (kind.warm)
    for (const Check check : {Check::rigid, Check::zero}) s.skip[check] = "warmth has forces at rest";
  for (const Check check : {Check::rigid, Check::objectivity}) {
    if (kind.linear) s.skip[check] = "small displacements do not turn far";
    if (axi) s.skip[check] = "the axis stands still";
  }
  if (axi || kind.curved) s.skip[Check::rotated_copy] = "the axis is global";
  return s;
}

TEST(Cell, Suite) {
  for (const std::size_t count : {3U, 6U, 4U, 8U})
    for (const Hypothesis hypothesis : hypotheses)
      for (const Kind kind :
           {Kind{true}, Kind{false}, Kind{false, true}, Kind{true, false, true}, Kind{false, false, true},
            Kind{true, false, false, 0.3}, Kind{false, false, false, 0.3}, Kind{false, true, false, 0.3},
            Kind{true, false, false, 0, true}, Kind{false, false, false, 0, true}, Kind{false, true, false, 0, true},
            Kind{false, true, true, 0.3, true}, Kind{true, false, false, 0, true, true}, Kind{false, false, false, 0, true, true},
            Kind{true, false, false, 0.3, true, true}, Kind{false, false, false, 0.3, true, true}})
        run_suite(subject(count, hypothesis, kind));
}

/// One mass matrix for inertia and weight: a body that falls freely has no stress.
TEST(Cell, FreeFallMakesNoForce) {
  for (const std::size_t count : {3U, 6U, 4U, 8U})
    for (const Hypothesis hypothesis : hypotheses)
      for (const bool lumped : {false, true}) {
        const auto places = distorted(count);
        const auto element = cell(places, section(hypothesis, Kind{false, false, lumped}));
        StateBuffer state(*element, node_map(places));
        state.gravity = {3, -9, 0};
        double weight = 0, pull = 0;
        const auto still = residual_of(*element, state);
        for (const double r : still) weight = std::max(weight, std::abs(r));
        EXPECT_GT(weight, 0.1);
        for (std::size_t i = 0; i < count; ++i) pull -= still[6 * i];
        const bool axi = hypothesis == Hypothesis::axisymmetric;
        EXPECT_NEAR(pull, 3 * density * (axi ? 1 : thickness) * area_of(places, axi), 1e-13 * pull) << count << " nodes";
        for (NodeState& node : state.nodes) node.a = state.gravity;
        for (const double r : residual_of(*element, state)) EXPECT_NEAR(r, 0, 1e-13 * weight) << count << " nodes";
      }
}

/// Masses at the nodes are above zero, sum up to the mass of the cell, and stand alone in the matrix.
TEST(Cell, LumpedMassesAreADiagonal) {
  for (const std::size_t count : {3U, 6U, 4U, 8U})
    for (const Hypothesis hypothesis : hypotheses) {
      const auto places = distorted(count);
      const auto element = cell(places, section(hypothesis, Kind{true, false, true}));
      const auto mass = tangent_of(*element, StateBuffer(*element, node_map(places)), {0, 0, 1});
      const bool axi = hypothesis == Hypothesis::axisymmetric;
      double sum = 0;
      for (std::size_t i = 0; i < 6 * count; ++i)
        for (std::size_t j = 0; j < 6 * count; ++j) {
          const double m = mass[i * 6 * count + j];
          EXPECT_TRUE(i == j ? i % 6 >= 2 || m > 0 : m == 0) << i << ", " << j << ": " << m;
          if (i == j && i % 6 == 0) sum += m;
        }
      EXPECT_NEAR(sum, density * (axi ? 1 : thickness) * area_of(places, axi), 1e-13 * sum);
    }
}

/// With large displacements the centrifugal load grows with the distance from the axis; its derivative is −ω² times the mass
/// matrix across the axis.
TEST(Cell, CentrifugalTangentIsTheDerivative) {
  for (const std::size_t count : {3U, 6U, 4U, 8U})
    for (const Hypothesis hypothesis : hypotheses) {
      const auto places = distorted(count);
      const bool axi = hypothesis == Hypothesis::axisymmetric;
      CellPlan plan = plan_of(places, section(hypothesis, false));
      const auto still = make_plane_cell(plan, nullptr);
      auto turn = std::make_shared<CellRotation>();
      turn->speed = 3;
      if (axi) turn->axis = Vec3::UnitY();
      if (!axi) turn->point = Vec3(0.4, -0.7, 5);
      plan.rotation = turn;
      const auto turning = make_plane_cell(plan, nullptr);
      const NodeMap nodes = node_map(places);
      StateBuffer state(*turning, nodes);
      const std::size_t width = 6 * count;  // of residual_of()
      const auto load = [&] {               // the residual of the load alone
        std::vector<double> with = residual_of(*turning, state);
        const std::vector<double> without = residual_of(*still, state);
        for (std::size_t i = 0; i < width; ++i) with[i] -= without[i];
        return with;
      };
      const auto stiff = tangent_of(*turning, state, {1, 0, 0}), plain = tangent_of(*still, state, {1, 0, 0});
      const auto at_rest = load();
      for (std::size_t node = 0; node < count; ++node)
        for (const std::size_t along : {0U, 1U}) {
          const std::size_t j = 6 * node + along;
          double& x = state.nodes[node].x[static_cast<Eigen::Index>(along)];
          const double before = x;
          x += 0.05;  // the load is linear
          const auto now = load();
          x = before;
          for (std::size_t i = 0; i < width; ++i)
            EXPECT_NEAR(stiff[i * width + j] - plain[i * width + j], (now[i] - at_rest[i]) / 0.05, 1e-11 * young)
                << count << " nodes, " << i << ", " << j;
        }
    }
}

TEST(Cell, LinearIsTheDerivativeAtRest) {
  for (const std::size_t count : {3U, 6U, 4U, 8U})
    for (const Hypothesis hypothesis : hypotheses) {
      const auto places = distorted(count);
      const auto large = cell(places, section(hypothesis, false)), small = cell(places, section(hypothesis, true));
      const NodeMap nodes = node_map(places);
      const auto a = tangent_of(*large, StateBuffer(*large, nodes), {1, 0, 0}),
                 b = tangent_of(*small, StateBuffer(*small, nodes), {1, 0, 0});
      for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-13 * young) << count << " nodes, entry " << i;
    }
}

TEST(Cell, RigidTurnsHaveNoStressWhateverTheirSize) {
  for (const std::size_t count : {3U, 6U, 4U, 8U})
    for (const Hypothesis hypothesis : {Hypothesis::plane_stress, Hypothesis::plane_strain})
      for (const double angle : {0.3, 2.0, 3.1}) {
        const auto places = distorted(count);
        const Eigen::Matrix2d turn = Eigen::Rotation2Dd(angle).toRotationMatrix();
        for (const bool rubber : {false, true}) {
          const auto element = cell(places, section(hypothesis, Kind{false, rubber}));
          const StateBuffer state = moved(*element, node_map(places), [&](const Eigen::Vector2d& x) {
            return Eigen::Vector2d(turn * x - x + Eigen::Vector2d(3, -2));
          });
          EXPECT_LT(field_of(*element, state, "STRESS").cwiseAbs().maxCoeff(), 1e-12 * young);
          for (const double r : residual_of(*element, state)) EXPECT_NEAR(r, 0, 1e-12 * young);
        }
      }
}

/// The strains of a mirrored cell are none, but it is no answer: its forces are no numbers. Small displacements know no sides.
TEST(Cell, InsideOutHasNoForces) {
  for (const std::size_t count : {3U, 6U, 4U, 8U})
    for (const Hypothesis hypothesis : {Hypothesis::plane_stress, Hypothesis::plane_strain})
      for (const bool linear : {true, false}) {
        const auto places = distorted(count);
        const auto element = cell(places, section(hypothesis, linear));
        const auto r = residual_of(
            *element, moved(*element, node_map(places), [](const Eigen::Vector2d& x) { return Eigen::Vector2d(-2 * x[0], 0); }));
        EXPECT_EQ(std::isfinite(r[0]), linear) << count << " nodes";
      }
}

/// Constant strains of any size: stress is that of the law at every point, and the cell carries it alone.
TEST(Cell, ConstantStrainsAreExactInAnyShape) {
  Eigen::Matrix2d slope;
  slope << 0.02, -0.05, 0.08, -0.03;
  for (const std::size_t count : {3U, 6U, 4U, 8U})
    for (const Hypothesis hypothesis : {Hypothesis::plane_stress, Hypothesis::plane_strain})
      for (const bool linear : {true, false}) {
        const auto places = distorted(count);
        const auto element = cell(places, section(hypothesis, linear));
        const StateBuffer state =
            moved(*element, node_map(places), [&](const Eigen::Vector2d& x) { return Eigen::Vector2d(slope * x); });
        Eigen::Matrix2d E = (slope + slope.transpose()) / 2;
        if (!linear) E += slope.transpose() * slope / 2;
        const double G = young / (2 * (1 + poisson)), plane = hypothesis == Hypothesis::plane_stress
                                                                  ? young * poisson / (1 - poisson * poisson)
                                                                  : young * poisson / ((1 + poisson) * (1 - 2 * poisson));
        const Eigen::Matrix2d S = 2 * G * E + plane * E.trace() * Eigen::Matrix2d::Identity();
        const double Ezz = hypothesis == Hypothesis::plane_stress ? -poisson / (1 - poisson) * E.trace() : 0;
        const Eigen::Matrix2d F = Eigen::Matrix2d::Identity() + slope;
        const double volume = linear ? 1 : F.determinant() * std::sqrt(1 + 2 * Ezz);
        const Eigen::Matrix2d sigma = linear ? S : Eigen::Matrix2d(F * S * F.transpose() / volume);
        const Eigen::MatrixXd stress = field_of(*element, state, "STRESS"), strain = field_of(*element, state, "STRAIN");
        for (Eigen::Index p = 0; p < stress.rows(); ++p) {
          EXPECT_NEAR(stress(p, 0), sigma(0, 0), 1e-12 * young);
          EXPECT_NEAR(stress(p, 1), sigma(1, 1), 1e-12 * young);
          EXPECT_NEAR(stress(p, 3), sigma(0, 1), 1e-12 * young);
          EXPECT_NEAR(strain(p, 2), Ezz, 1e-13);
          EXPECT_NEAR(strain(p, 3), E(0, 1), 1e-13);
          const double shear = stress(p, 3), a = stress(p, 0), b = stress(p, 1), c = stress(p, 2);
          EXPECT_NEAR(std::pow(field_of(*element, state, "VON_MISES")(p, 0), 2),
                      a * a + b * b + c * c - a * b - b * c - c * a + 3 * shear * shear, 1e-10);
        }
        const double energy = element->energies(state.view()).strain;
        const double expected = thickness * area_of(places, false) * (S.cwiseProduct(E)).sum() / 2;
        EXPECT_NEAR(energy, expected, 1e-12 * young) << count << " nodes";
      }
}

/// Bending of a rectangle in its plane: the modes give the cell of four nodes the exact energy, without them it is too stiff.
TEST(Cell, FourNodesBendExactlyInARectangle) {
  const std::vector<Eigen::Vector2d> places{{0, -0.5}, {3, -0.5}, {3, 0.5}, {0, 0.5}};
  const auto element = cell(places, section(Hypothesis::plane_stress, true));
  constexpr double curvature = 0.01;
  // u = -κ x y of pure bending at the corners, with any rigid part of v
  const StateBuffer state = moved(*element, node_map(places), [&](const Eigen::Vector2d& x) {
    return Eigen::Vector2d(-curvature * x[0] * x[1], curvature * x[0] * x[0] / 2);
  });
  EXPECT_NEAR(element->energies(state.view()).strain, young * thickness / 12 * curvature * curvature * 3 / 2, 1e-13);
}

/// Only rigid motions are free of forces: no cell has a mechanism of its own, but for eight nodes with 2 × 2 points.
TEST(Cell, MechanismsAreCounted) {
  for (const Hypothesis hypothesis : hypotheses)
    for (const std::size_t count : {3U, 6U, 4U, 8U}) {
      const auto places = distorted(count);
      const auto element = cell(places, section(hypothesis, true));
      const auto full = tangent_of(*element, StateBuffer(*element, node_map(places)), {1, 0, 0});
      const auto n = static_cast<Eigen::Index>(2 * count);
      Eigen::MatrixXd k(n, n);
      for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < n; ++j)
          k(i, j) =
              full[static_cast<std::size_t>((6 * (i / 2) + i % 2) * 6 * static_cast<Eigen::Index>(count) + 6 * (j / 2) + j % 2)];
      const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k).eigenvalues();
      const auto free = (values.array() < 1e-10 * values.maxCoeff()).count();
      const Eigen::Index rigid = hypothesis == Hypothesis::axisymmetric ? 1 : 3;
      EXPECT_EQ(free, rigid + (count == 8 && hypothesis != Hypothesis::axisymmetric ? 1 : 0)) << count << " nodes";
      EXPECT_GT(values.minCoeff(), -1e-12 * values.maxCoeff());
    }
}

/// A ring that grows by u = c r has the strain c along the radius and round the axis.
TEST(Cell, RingsGrow) {
  for (const std::size_t count : {3U, 6U, 4U, 8U})
    for (const bool linear : {true, false}) {
      const auto places = distorted(count);
      const auto element = cell(places, section(Hypothesis::axisymmetric, linear));
      constexpr double c = 0.02;
      const StateBuffer state =
          moved(*element, node_map(places), [&](const Eigen::Vector2d& x) { return Eigen::Vector2d(c * x[0], 0); });
      const double e = linear ? c : c + c * c / 2;
      const Eigen::MatrixXd strain = field_of(*element, state, "STRAIN");
      for (Eigen::Index p = 0; p < strain.rows(); ++p) {
        EXPECT_NEAR(strain(p, 0), e, 1e-13);
        EXPECT_NEAR(strain(p, 1), 0, 1e-13);
        EXPECT_NEAR(strain(p, 2), e, 1e-13);
      }
    }
}

/// A warm body that is free in its plane: no stress there; in plane strain it grows by 1 + ν as much and is pressed along z.
TEST(Cell, WarmthOfABodyFreeInItsPlane) {
  constexpr double alpha = 1e-3, rise = 7;
  for (const std::size_t count : {3U, 6U, 4U, 8U})
    for (const Hypothesis hypothesis : hypotheses) {
      materials::Elastic material = materials::isotropic(young, poisson);
      material.expansion.head<3>().setConstant(alpha);
      const auto of = std::make_shared<CellSection>(CellSection{hypothesis, materials::law_of(hypothesis, material), 1, true});
      const auto places = distorted(count);
      const auto element = cell(places, of, rise);
      const bool held = hypothesis == Hypothesis::plane_strain;
      const double grows = alpha * rise * (held ? 1 + poisson : 1);
      const StateBuffer state =
          moved(*element, node_map(places), [&](const Eigen::Vector2d& x) { return Eigen::Vector2d(grows * x); });
      const Eigen::MatrixXd stress = field_of(*element, state, "STRESS"), strain = field_of(*element, state, "STRAIN");
      for (Eigen::Index p = 0; p < stress.rows(); ++p) {
        for (const Eigen::Index k : {0, 1, 3}) EXPECT_NEAR(stress(p, k), 0, 1e-13 * young);
        EXPECT_NEAR(stress(p, 2), held ? -young * alpha * rise : 0, 1e-13 * young);
        EXPECT_NEAR(strain(p, 2), held ? 0 : alpha * rise, 1e-15);
      }
      for (const double r : residual_of(*element, state)) EXPECT_NEAR(r, 0, 1e-13 * young);
      const double stored = field_of(*element, state, "STRAIN_ENERGY_DENSITY")(0, 0);
      EXPECT_NEAR(stored, held ? young * std::pow(alpha * rise, 2) / 2 : 0, 1e-15);
      EXPECT_NEAR(element->energies(state.view()).strain, held ? stored * area_of(places, false) : 0, 1e-14);
    }
}

/// Warm rubber grows by 1 + α ΔT, however far, and has no stress if it is free; turned as well.
TEST(Cell, WarmRubberGrowsFreely) {
  for (const std::size_t count : {3U, 6U, 4U, 8U})
    for (const Hypothesis hypothesis : {Hypothesis::plane_stress, Hypothesis::axisymmetric})
      for (const double rise : {150.0, -200.0}) {
        const auto places = distorted(count);
        const auto element = cell(places, section(hypothesis, Kind{false, true, false, 0, true}), rise);
        const Eigen::Matrix2d turn =
            (1 + expansion * rise) * Eigen::Rotation2Dd(hypothesis == Hypothesis::axisymmetric ? 0 : 2.1).toRotationMatrix();
        const StateBuffer state =
            moved(*element, node_map(places), [&](const Eigen::Vector2d& x) { return Eigen::Vector2d(turn * x - x); });
        const Eigen::MatrixXd stress = field_of(*element, state, "STRESS"), strain = field_of(*element, state, "STRAIN");
        EXPECT_LT(stress.cwiseAbs().maxCoeff(), 1e-12 * young) << count << " nodes";
        for (Eigen::Index p = 0; p < strain.rows(); ++p)
          EXPECT_NEAR(strain(p, 2), expansion * rise * (1 + expansion * rise / 2), 1e-13);
        for (const double r : residual_of(*element, state)) EXPECT_NEAR(r, 0, 1e-12 * young);
        EXPECT_NEAR(element->energies(state.view()).strain, 0, 1e-14 * young);
      }
}

/// The smaller the warmth, the closer are forces of rubber to those of the linear material with small displacements.
TEST(Cell, SlightlyWarmRubberIsLinear) {
  for (const std::size_t count : {3U, 6U, 4U, 8U})
    for (const Hypothesis hypothesis : hypotheses)
      for (const double rise : {1e-3, 1e-5}) {
        const auto places = distorted(count);
        const auto forces = [&](Kind kind) {
          const auto element = cell(places, section(hypothesis, kind), rise);
          const auto r = residual_of(*element, StateBuffer(*element, node_map(places)));
          return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(r.data(), static_cast<Eigen::Index>(r.size())));
        };
        const Eigen::VectorXd rubber = forces({false, true, false, 0, true}), linear = forces({true, false, false, 0, true});
        const double largest = linear.cwiseAbs().maxCoeff();
        EXPECT_GT(largest, 0.1 * young * expansion * rise);
        EXPECT_LT((rubber - linear).cwiseAbs().maxCoeff(), 10 * expansion * rise * largest) << count << " nodes";
      }
}

TEST(Cell, NodesAreOrdered) {
  const auto nodes = [](std::vector<int> written) { return connectivity(written)->nodes; };
  EXPECT_EQ(nodes({5, 6, 7}), (std::vector{5, 6, 7}));
  EXPECT_EQ(nodes({1, -4, 2, -5, 3, -6}), (std::vector{1, 2, 3, 4, 5, 6}));
  for (const std::vector<int>& wrong : std::vector<std::vector<int>>{{1, -4, 2, -5, 3},
                                                                     {1, 2, 3, -4, -5, -6},
                                                                     {1, 2, 3, 4, 5},
                                                                     {1, 2, 3, 0, 4, 5},
                                                                     {1, 2, 3, 4, 0, 5},
                                                                     {1, -5, 2, -6, 3, -7, 0, 4},
                                                                     {1, 2, 3, 0, 8, 9, 10, 0, 4},
                                                                     {0}})
    EXPECT_FALSE(connectivity(wrong));
}

}  // namespace
}  // namespace engrane::elements::structural::plane_cells
