// SPDX-License-Identifier: BSD-3-Clause
#include "elements/structural/cell.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <map>
#include <numbers>

#include "elements/structural/cell_topology.hpp"
#include "elements/structural/make_cell.hpp"
#include "elements/suite.hpp"
#include "math/rotation.hpp"

namespace engrane::elements::structural {
namespace {

using namespace suite;
using materials::Hypothesis;

constexpr double young = 70, poisson = 0.3, density = 2.7, thickness = 0.4;

/// What a section has beside its hypothesis.
struct Kind {
  bool linear = false, rubber = false, lumped = false;
  double damping = 0;
};

std::shared_ptr<const CellSection> section(Hypothesis hypothesis, Kind kind) {
  materials::Elastic material = materials::isotropic(young, poisson);
  material.density = density;
  material.damping = kind.damping;
  if (kind.rubber) material.neo_hookean = materials::neo_hookean(young, poisson);
  return std::make_shared<CellSection>(CellSection{hypothesis, materials::law_of(hypothesis, material),
                                                   hypothesis == Hypothesis::axisymmetric ? 1 : thickness, kind.linear, 0,
                                                   kind.lumped});
}
std::shared_ptr<const CellSection> section(Hypothesis hypothesis, bool linear) { return section(hypothesis, Kind{linear}); }

/// A distorted cell of each kind, sides of 6 and 8 nodes curved, away from the axis.
std::vector<Eigen::Vector2d> distorted(std::size_t count) {
  std::vector<Eigen::Vector2d> x{{1, 0.1}, {2.3, -0.2}, {2.1, 1.3}};
  if (count == 4 || count == 8) x.emplace_back(0.8, 0.9);
  const std::size_t corners = x.size();
  if (count > corners) {
    const Eigen::Vector2d bend[] = {{0.03, 0.05}, {-0.06, 0.02}, {0.04, -0.03}, {0.02, 0.05}};
    for (std::size_t i = 0; i < corners; ++i) x.emplace_back((x[i] + x[(i + 1) % corners]) / 2 + bend[i]);
  }
  return x;
}

std::vector<int> numbers(std::size_t count) {
  std::vector<int> ids;
  for (std::size_t i = 0; i < count; ++i) ids.push_back(static_cast<int>(i) + 1);
  return ids;
}

NodeMap node_map(const std::vector<Eigen::Vector2d>& places) {
  NodeMap nodes;
  for (std::size_t i = 0; i < places.size(); ++i) nodes[static_cast<int>(i) + 1] = {places[i][0], places[i][1], 0};
  return nodes;
}

CellPlan plan_of(const std::vector<Eigen::Vector2d>& places, const std::shared_ptr<const CellSection>& of) {
  const std::map<std::size_t, CellShape> shapes{
      {3, CellShape::triangle}, {6, CellShape::triangle6}, {4, CellShape::quadrilateral}, {8, CellShape::quadrilateral8}};
  CellPlan plan{1, shapes.at(places.size()), numbers(places.size()), {}, of};
  for (const Eigen::Vector2d& x : places) plan.places.emplace_back(x[0], x[1], 0);
  return plan;
}

std::unique_ptr<Element> cell(const std::vector<Eigen::Vector2d>& places, const std::shared_ptr<const CellSection>& of,
                              double rise = 0) {
  CellPlan plan = plan_of(places, of);
  if (rise != 0) plan.warmth = std::make_shared<const std::vector<Warmth>>(places.size(), Warmth{rise});
  return make_plane_cell(plan, nullptr);
}

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

Subject subject(std::size_t count, Hypothesis hypothesis, Kind kind) {
  const bool axi = hypothesis == Hypothesis::axisymmetric;
  Subject s;
  s.name = std::to_string(count) + " nodes, hypothesis " + std::to_string(static_cast<int>(hypothesis)) +
           (kind.linear ? ", small" : ", large") + (kind.rubber ? ", neo-Hookean" : "") + (kind.lumped ? ", lumped" : "") +
           (kind.damping > 0 ? ", damped" : "");
  s.nodes = node_map(distorted(count));
  s.in_plane = true;
  s.length = 0.06;  // a cell of four nodes finds its modes for strains of this size
  s.step = 1e-2;
  s.build = [=](const Mat3& Q) {
    auto places = distorted(count);
    for (Eigen::Vector2d& x : places) x = (Q * Vec3(x[0], x[1], 0)).head<2>();
    return cell(places, section(hypothesis, kind));
  };
  s.mass = density * (axi ? 1 : thickness) * area_of(distorted(count), axi);
  s.skip[Check::equilibrium] = "inertia and weight are outer forces";
  if (kind.damping > 0) s.skip[Check::lagrange] = "a damper has no potential";
  for (const Check check : {Check::rigid, Check::objectivity}) {
    if (kind.linear) s.skip[check] = "small displacements do not turn far";
    if (axi) s.skip[check] = "the axis stands still";
  }
  if (axi) s.skip[Check::rotated_copy] = "the axis is global";
  return s;
}

constexpr Hypothesis hypotheses[] = {Hypothesis::plane_stress, Hypothesis::plane_strain, Hypothesis::axisymmetric};

TEST(Cell, Suite) {
  for (const std::size_t count : {3U, 6U, 4U, 8U})
    for (const Hypothesis hypothesis : hypotheses)
      for (const Kind kind : {Kind{true}, Kind{false}, Kind{false, true}, Kind{true, false, true}, Kind{false, false, true},
                              Kind{true, false, false, 0.3}, Kind{false, false, false, 0.3}, Kind{false, true, false, 0.3}})
        run_suite(subject(count, hypothesis, kind));
}

/// One mass matrix for inertia and weight: a body that falls freely has no stress.
TEST(Cell, FreeFallMakesNoForce) {
  for (const std::size_t count : {3U, 6U, 4U, 8U})
    for (const Hypothesis hypothesis : hypotheses)
      for (const bool lumped : {false, true}) {
        // the weight of 6 nodes is that of 3 points, which is not exact where sides are curved
        if (count == 6 && !lumped && hypothesis != Hypothesis::axisymmetric) continue;
        const auto places = distorted(count);
        const auto element = cell(places, section(hypothesis, Kind{false, false, lumped}));
        StateBuffer state(*element, node_map(places));
        state.gravity = {3, -9, 0};
        double weight = 0;
        for (const double r : residual_of(*element, state)) weight = std::max(weight, std::abs(r));
        EXPECT_GT(weight, 0.1);
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

/// Moves all nodes by a function of their place.
template <class Move>
StateBuffer moved(const Element& element, const NodeMap& nodes, const Move& move) {
  StateBuffer state(element, nodes);
  for (NodeState& node : state.nodes) {
    const Eigen::Vector2d u = move(Eigen::Vector2d(node.x.head<2>()));
    node.x += Vec3(u[0], u[1], 0);
  }
  return state;
}

/// All values of a field at all points, a row for each point.
Eigen::MatrixXd field_of(const Element& element, const StateBuffer& state, const std::string& name) {
  std::vector<double> values;
  std::size_t size = 0, at = 0, width = 0, points = 0;
  for (const Field& field : element.fields()) {
    if (field.name == name) {
      at = size;
      width = std::max<std::size_t>(field.components.size(), 1);
      points = static_cast<std::size_t>(field.points);
    }
    size += field.size(element.node_ids().size());
  }
  values.resize(size);
  element.evaluate_fields(state.view(), values);
  Eigen::MatrixXd rows(points, width);
  for (std::size_t i = 0; i < points; ++i)
    for (std::size_t k = 0; k < width; ++k)
      rows(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) = values[at + i * width + k];
  return rows;
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

/// A stress without forces in the middle of a patch: the node where distorted cells meet stays in balance.
TEST(Cell, PatchesOfDistortedCellsAreInBalance) {
  // four cells round node 9 of a square with an inner node out of the middle
  const std::vector<Eigen::Vector2d> grid{{0, 0}, {1.1, 0}, {2, 0}, {2, 0.8}, {2, 2}, {0.7, 2}, {0, 2}, {0, 1.2}, {1.3, 0.9}};
  const std::vector<std::vector<int>> quads{{0, 1, 8, 7}, {1, 2, 3, 8}, {8, 3, 4, 5}, {7, 8, 5, 6}};
  Eigen::Matrix2d slope;
  slope << 0.03, -0.02, 0.07, 0.05;
  for (const Hypothesis hypothesis : {Hypothesis::plane_stress, Hypothesis::plane_strain})
    for (const bool linear : {true, false})
      for (const std::size_t count : {3U, 4U, 6U, 8U}) {
        Eigen::Vector2d sum = Eigen::Vector2d::Zero();
        double largest = 0;
        for (const std::vector<int>& quad : quads) {
          std::vector<std::vector<int>> cells{quad};
          if (count == 3 || count == 6) cells = {{quad[0], quad[1], quad[2]}, {quad[0], quad[2], quad[3]}};
          for (const std::vector<int>& corners : cells) {
            std::vector<Eigen::Vector2d> places;
            for (const int i : corners) places.push_back(grid[static_cast<std::size_t>(i)]);
            if (count > places.size())
              for (std::size_t i = 0; i < corners.size(); ++i)
                places.emplace_back((places[i] + places[(i + 1) % corners.size()]) / 2);
            const auto element = cell(places, section(hypothesis, linear));
            const StateBuffer state =
                moved(*element, node_map(places), [&](const Eigen::Vector2d& x) { return Eigen::Vector2d(slope * x); });
            const auto r = residual_of(*element, state);
            for (std::size_t i = 0; i < corners.size(); ++i) {
              largest = std::max(largest, std::abs(r[6 * i]));
              if (corners[i] == 8) sum += Eigen::Vector2d(r[6 * i], r[6 * i + 1]);
            }
          }
        }
        EXPECT_GT(largest, 0.1);
        EXPECT_LT(sum.norm(), 1e-13 * young) << count << " nodes";
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
}  // namespace engrane::elements::structural
