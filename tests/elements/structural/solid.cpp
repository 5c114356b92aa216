// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <map>
#include <random>

#include "elements/structural/cell_shapes.hpp"
#include "elements/structural/cell_topology.hpp"
#include "elements/structural/make_cell.hpp"
#include "elements/suite.hpp"
#include "math/rotation.hpp"

namespace engrane::elements::structural {
namespace {

using namespace suite;
using materials::Hypothesis;

constexpr double young = 70, poisson = 0.3, density = 2.7;
constexpr CellShape solids[] = {CellShape::tetrahedron, CellShape::tetrahedron10, CellShape::wedge,
                                CellShape::wedge15,     CellShape::hexahedron,    CellShape::hexahedron20};

std::shared_ptr<const CellSection> rubber_section(double expansion) {
  materials::Elastic material = materials::isotropic(young, poisson);
  material.density = density;
  material.expansion.head<3>().setConstant(expansion);
  material.neo_hookean = materials::neo_hookean(young, poisson);
  return std::make_shared<CellSection>(CellSection{Hypothesis::solid, materials::law_of(Hypothesis::solid, material), 1, false});
}
std::shared_ptr<const CellSection> section(bool linear, materials::Elastic material = materials::isotropic(young, poisson)) {
  material.density = density;
  return std::make_shared<CellSection>(CellSection{Hypothesis::solid, materials::law_of(Hypothesis::solid, material), 1, linear});
}

/// Of a material whose axes are those of a spherical frame about a point beside the cells.
std::shared_ptr<const CellSection> curved_section(bool linear) {
  materials::Elastic material = materials::orthotropic({Vec3(140, 60, 50), Vec3(0.2, 0.25, 0.15), Vec3(30, 25, 28)});
  material.density = density;
  material.expansion.head<3>() << 1e-3, 3e-4, -2e-4;
  CellSection of{Hypothesis::solid, materials::law_of(Hypothesis::solid, material), 1, linear};
  of.curved = CurvedLaw{Hypothesis::solid, material, [](const Vec3& place) {
                          const Vec3 x = place - Vec3(-2, -3, -4);
                          return Mat3(rotation_exp(std::atan2(x[1], x[0]) * Vec3::UnitZ()) *
                                      rotation_exp(-std::atan2(x[2], std::hypot(x[0], x[1])) * Vec3::UnitY()));
                        }};
  return std::make_shared<CellSection>(of);
}

/// Corners of the reference cell, in the order of CellShape.
std::vector<Vec3> reference_corners(CellShape shape) {
  switch (corner_count(shape)) {
    case 4:
      return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    case 6:
      return {{0, 0, -1}, {1, 0, -1}, {0, 1, -1}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
    default:
      return {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}};
  }
}

/// With the middles of the sides, where the cell has them.
std::vector<Vec3> with_middles(CellShape shape, std::vector<Vec3> x) {
  if (has_middles(shape))
    for (const auto& [a, b] : sides(shape)) x.emplace_back((x[static_cast<std::size_t>(a)] + x[static_cast<std::size_t>(b)]) / 2);
  return x;
}

/// A cell whose corners have moved, and whose sides are bent unless they are to be straight.
std::vector<Vec3> distorted(CellShape shape, bool straight = false) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> shift(-0.12, 0.12), bend(-0.04, 0.04);
  std::vector<Vec3> x = reference_corners(shape);
  for (Vec3& p : x)
    p = Vec3(0.9 * p[0] + 0.2 * p[1], p[1], 0.7 * p[2] - 0.1 * p[0]) + Vec3(shift(random), shift(random), shift(random));
  const std::size_t corners = x.size();
  x = with_middles(shape, x);
  for (std::size_t i = corners; i < x.size() && !straight; ++i) x[i] += Vec3(bend(random), bend(random), bend(random));
  return x;
}

NodeMap node_map(const std::vector<Vec3>& places) {
  NodeMap nodes;
  for (std::size_t i = 0; i < places.size(); ++i) nodes[static_cast<int>(i) + 1] = places[i];
  return nodes;
}

std::unique_ptr<Element> cell(CellShape shape, const std::vector<Vec3>& places, const std::shared_ptr<const CellSection>& of,
                              double rise = 0) {
  CellPlan plan{1, shape, {}, places, of};
  for (std::size_t i = 0; i < places.size(); ++i) plan.nodes.push_back(static_cast<int>(i) + 1);
  if (rise != 0) plan.warmth = std::make_shared<const std::vector<Warmth>>(places.size(), Warmth{rise});
  return make_solid_cell(plan, nullptr);
}

/// The same with temperatures that vary from node to node, and with time.
std::unique_ptr<Element> warm_cell(CellShape shape, const std::vector<Vec3>& places,
                                   const std::shared_ptr<const CellSection>& of) {
  static const Wave wave(0.3, 0.7, 1.9, 0.4);
  CellPlan plan{1, shape, {}, places, of};
  std::vector<Warmth> warmth;
  for (std::size_t i = 0; i < places.size(); ++i) {
    plan.nodes.push_back(static_cast<int>(i) + 1);
    warmth.push_back({20 + 3 * static_cast<double>(i), &wave});
  }
  plan.warmth = std::make_shared<const std::vector<Warmth>>(warmth);
  return make_solid_cell(plan, nullptr);
}

template <class Move>
StateBuffer moved(const Element& element, const std::vector<Vec3>& places, const Move& move) {
  StateBuffer state(element, node_map(places));
  for (NodeState& node : state.nodes) node.x += move(Vec3(node.x));
  return state;
}

/// The first field, STRESS, and the second, STRAIN: a row for each point.
Eigen::MatrixXd field_of(const Element& element, const StateBuffer& state, std::size_t index) {
  std::size_t size = 0, at = 0;
  for (std::size_t i = 0; i < element.fields().size(); ++i) {
    if (i == index) at = size;
    size += element.fields()[i].size(element.node_ids().size());
  }
  std::vector<double> values(size);
  element.evaluate_fields(state.view(), values);
  const Field& field = element.fields()[index];
  const auto width = static_cast<Eigen::Index>(std::max<std::size_t>(field.components.size(), 1));
  return Eigen::Map<Eigen::Matrix<double, -1, -1, Eigen::RowMajor>>(values.data() + at, field.points, width);
}

template <CellShape S>
void check_shape_functions() {
  using Traits = CellTraits<S>;
  const std::vector<Vec3> nodes = with_middles(S, reference_corners(S));
  ASSERT_EQ(nodes.size(), static_cast<std::size_t>(Traits::nodes));
  for (Eigen::Index i = 0; i < Traits::nodes; ++i) {
    const Vec3& x = nodes[static_cast<std::size_t>(i)];
    const auto s = Traits::sample({x[0], x[1], 1, x[2]});
    for (Eigen::Index j = 0; j < Traits::nodes; ++j) EXPECT_NEAR(s.value[j], i == j ? 1 : 0, 1e-15);
  }
  constexpr double h = 1e-5;
  const QuadraturePoint at{0.2, 0.31, 1, 0.13};
  const auto s = Traits::sample(at);
  EXPECT_NEAR(s.value.sum(), 1, 1e-15);
  for (int k = 0; k < 3; ++k) {
    const auto moved = [&](double by) {
      QuadraturePoint p = at;
      (k == 0 ? p.xi : k == 1 ? p.eta : p.zeta) += by;
      return Traits::sample(p).value;
    };
    EXPECT_LT((s.slope.row(k).transpose() - (moved(h) - moved(-h)) / (2 * h)).cwiseAbs().maxCoeff(), 1e-9);
  }
}

TEST(Solid, ShapeFunctions) {
  check_shape_functions<CellShape::tetrahedron>();
  check_shape_functions<CellShape::tetrahedron10>();
  check_shape_functions<CellShape::wedge>();
  check_shape_functions<CellShape::wedge15>();
  check_shape_functions<CellShape::hexahedron>();
  check_shape_functions<CellShape::hexahedron20>();
}

double factorial(int n) { return n < 2 ? 1 : n * factorial(n - 1); }

/// ∫ ξ^a η^b ζ^c over the reference tetrahedron is a! b! c! / (a + b + c + 3)!.
TEST(Solid, RulesOfTetrahedraAreExactToTheirDegree) {
  using Traits = CellTraits<CellShape::tetrahedron10>;
  for (const auto& [rule, degree] : {std::pair(&CellTraits<CellShape::tetrahedron>::stiffness_points(), 1),
                                     std::pair(&Traits::stiffness_points(), 2), std::pair(&Traits::mass_points(), 5)})
    for (int a = 0; a <= degree; ++a)
      for (int b = 0; a + b <= degree; ++b)
        for (int c = 0; a + b + c <= degree; ++c) {
          double sum = 0;
          for (const QuadraturePoint& p : *rule) sum += p.weight * std::pow(p.xi, a) * std::pow(p.eta, b) * std::pow(p.zeta, c);
          EXPECT_NEAR(sum, factorial(a) * factorial(b) * factorial(c) / factorial(a + b + c + 3), 1e-16);
        }
}

TEST(Solid, Suite) {
  enum class Kind { small, large, neo_hookean, lumped, damped_small, damped_large, warm_rubber, curved, curved_damped };
  for (const CellShape shape : solids)
    for (const auto& [one, name] :
         {std::pair(Kind::small, "small"), std::pair(Kind::large, "large"), std::pair(Kind::neo_hookean, "neo-Hookean"),
          std::pair(Kind::lumped, "lumped"), std::pair(Kind::damped_small, "damped, small"),
          std::pair(Kind::damped_large, "damped, large"), std::pair(Kind::warm_rubber, "neo-Hookean, warm"),
          std::pair(Kind::curved, "curved axes, warm, large"), std::pair(Kind::curved_damped, "curved axes, damped, small")}) {
      const Kind kind = one;  // lambdas cannot capture a structured binding
      const bool linear = kind == Kind::small || kind == Kind::damped_small || kind == Kind::curved_damped;
      const bool warm = kind == Kind::warm_rubber || kind == Kind::curved;
      const bool damped = kind == Kind::damped_small || kind == Kind::damped_large || kind == Kind::curved_damped;
      const bool curved = kind == Kind::curved || kind == Kind::curved_damped;
      Subject s;
      s.name = std::to_string(with_middles(shape, reference_corners(shape)).size()) + " nodes, " + name;
      s.nodes = node_map(distorted(shape));
      s.length = 0.05;                                   // a cell of eight nodes finds its modes for strains of this size
      s.step = kind == Kind::warm_rubber ? 5e-3 : 1e-2;  // warm cells are strained further, where the logarithm bends more
      s.build = [=](const Mat3& Q) {
        auto places = distorted(shape);
        for (Vec3& x : places) x = Q * x;
        if (kind == Kind::warm_rubber) return warm_cell(shape, places, rubber_section(1e-3));
        CellSection of = curved ? *curved_section(linear) : *section(linear);
        if (kind == Kind::neo_hookean) of.law.neo_hookean = materials::neo_hookean(young, poisson);
        of.lumped = kind == Kind::lumped;
        if (damped) of.law.damping = 0.3;
        if (damped && curved) of.curved->material.damping = 0.3;
        if (warm) return warm_cell(shape, places, std::make_shared<CellSection>(of));
        return cell(shape, places, std::make_shared<CellSection>(of));
      };
      s.skip[Check::equilibrium] = "inertia and weight are outer forces";
      if (damped) s.skip[Check::lagrange] = "a damper has no potential";
      if (curved) s.skip[Check::rotated_copy] = "the frame stands still";
      if (warm)
        for (const Check check : {Check::rigid, Check::zero}) s.skip[check] = "warmth has forces at rest";
      if (linear)
        for (const Check check : {Check::rigid, Check::objectivity}) s.skip[check] = "small displacements do not turn far";
      run_suite(s);
    }
}

/// One mass matrix for inertia and weight: a body that falls freely has no stress, whatever the form of its cells.
TEST(Solid, FreeFallMakesNoForce) {
  for (const CellShape shape : solids)
    for (const bool lumped : {false, true}) {
      CellSection of = *section(false);
      of.lumped = lumped;
      const auto places = distorted(shape);
      const auto element = cell(shape, places, std::make_shared<CellSection>(of));
      StateBuffer state(*element, node_map(places));
      state.gravity = {3, -9, 5};
      double weight = 0;
      for (const double r : residual_of(*element, state)) weight = std::max(weight, std::abs(r));
      EXPECT_GT(weight, 0.1);
      for (NodeState& node : state.nodes) node.a = state.gravity;
      for (const double r : residual_of(*element, state)) EXPECT_NEAR(r, 0, 1e-13 * weight) << places.size() << " nodes";
    }
}

TEST(Solid, LinearIsTheDerivativeAtRest) {
  for (const CellShape shape : solids) {
    const auto places = distorted(shape);
    const auto large = cell(shape, places, section(false)), small = cell(shape, places, section(true));
    const NodeMap nodes = node_map(places);
    const auto a = tangent_of(*large, StateBuffer(*large, nodes), {1, 0, 0}),
               b = tangent_of(*small, StateBuffer(*small, nodes), {1, 0, 0});
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-13 * young);
  }
}

TEST(Solid, RigidTurnsHaveNoStressWhateverTheirSize) {
  for (const CellShape shape : solids) {
    const auto places = distorted(shape);
    const auto element = cell(shape, places, section(false));
    const Mat3 turn = rotation_exp(Vec3(1.3, -0.8, 2));
    const StateBuffer state = moved(*element, places, [&](const Vec3& x) { return Vec3(turn * x - x + Vec3(3, -2, 1)); });
    EXPECT_LT(field_of(*element, state, 0).cwiseAbs().maxCoeff(), 1e-12 * young);
    for (const double r : residual_of(*element, state)) EXPECT_NEAR(r, 0, 1e-12 * young);
  }
}

/// Constant strains of any size in cells of any form: stress is that of the law at every point.
TEST(Solid, ConstantStrainsAreExactInAnyForm) {
  Mat3 slope;
  slope << 0.02, -0.05, 0.03, 0.08, -0.03, 0.01, -0.02, 0.04, 0.05;
  for (const CellShape shape : solids)
    for (const bool linear : {true, false}) {
      const auto places = distorted(shape);
      const auto element = cell(shape, places, section(linear));
      const StateBuffer state = moved(*element, places, [&](const Vec3& x) { return Vec3(slope * x); });
      Mat3 E = (slope + slope.transpose()) / 2;
      if (!linear) E += slope.transpose() * slope / 2;
      const Mat3 S = young / (1 + poisson) * (E + poisson / (1 - 2 * poisson) * E.trace() * Mat3::Identity());
      const Mat3 F = Mat3::Identity() + slope, sigma = linear ? S : Mat3(F * S * F.transpose() / F.determinant());
      const Eigen::MatrixXd stress = field_of(*element, state, 0);
      const double expected[6] = {sigma(0, 0), sigma(1, 1), sigma(2, 2), sigma(0, 1), sigma(1, 2), sigma(2, 0)};
      for (Eigen::Index p = 0; p < stress.rows(); ++p)
        for (Eigen::Index k = 0; k < 6; ++k) EXPECT_NEAR(stress(p, k), expected[k], 1e-12 * young);
    }
}

/// Eight distorted boxes, cut into cells of one shape: the inner nodes stay in balance under a linear field.
TEST(Solid, PatchesOfDistortedCellsAreInBalance) {
  Mat3 slope;
  slope << 0.03, -0.02, 0.01, 0.07, 0.05, -0.03, 0.02, 0.01, -0.04;
  // 3 × 3 × 3 corners, moved inside the body and within its faces
  std::mt19937 random(3);
  std::uniform_real_distribution<double> shift(-0.2, 0.2);
  std::vector<Vec3> grid;
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) {
        Vec3 x(i, j, k);
        for (int a = 0; a < 3; ++a)
          if (x[a] == 1) x[a] += shift(random);
        grid.push_back(x);
      }
  const std::vector<std::vector<int>> tetrahedra{{0, 1, 3, 4}, {1, 2, 3, 6}, {1, 3, 4, 6}, {1, 4, 5, 6}, {3, 4, 6, 7}},
      wedges{{0, 1, 2, 4, 5, 6}, {0, 2, 3, 4, 6, 7}}, whole{{0, 1, 2, 3, 4, 5, 6, 7}};
  const std::shared_ptr<const CellSection> sections[] = {section(true), section(false), rubber_section(0), rubber_section(1e-3)};
  for (const CellShape shape : solids)
    for (const std::shared_ptr<const CellSection>& of_all : sections) {
      std::map<std::array<long, 3>, Vec3> inner;  // forces on nodes inside, by place
      double largest = 0;
      for (int box = 0; box < 8; ++box) {
        const int i0 = box % 2, j0 = box / 2 % 2, k0 = box / 4;
        const auto node = [&](int i, int j, int k) { return (i0 + i) + 3 * (j0 + j) + 9 * (k0 + k); };
        std::vector<int> corners{node(0, 0, 0), node(1, 0, 0), node(1, 1, 0), node(0, 1, 0),
                                 node(0, 0, 1), node(1, 0, 1), node(1, 1, 1), node(0, 1, 1)};
        // the cuts of neighbours meet when they are mirrored from box to box
        if ((i0 + j0 + (corner_count(shape) == 4 ? k0 : 0)) % 2 == 1)
          corners = {corners[1], corners[0], corners[3], corners[2], corners[5], corners[4], corners[7], corners[6]};
        const int count = corner_count(shape);
        for (const std::vector<int>& of : count == 4 ? tetrahedra : count == 6 ? wedges : whole) {
          std::vector<Vec3> places;
          for (const int c : of) places.push_back(grid[static_cast<std::size_t>(corners[static_cast<std::size_t>(c)])]);
          places = with_middles(shape, places);
          const auto element = cell(shape, places, of_all, of_all->law.expansion[0] * 1e5);
          const auto r = residual_of(*element, moved(*element, places, [&](const Vec3& x) { return Vec3(slope * x); }));
          for (std::size_t i = 0; i < places.size(); ++i) {
            const Vec3 force(r[6 * i], r[6 * i + 1], r[6 * i + 2]);
            largest = std::max(largest, force.norm());
            if ((places[i].array() <= 1e-9).any() || (places[i].array() >= 2 - 1e-9).any()) continue;
            const Vec3 key = 1e6 * places[i];
            inner.try_emplace({std::lround(key[0]), std::lround(key[1]), std::lround(key[2])}, Vec3::Zero()).first->second +=
                force;
          }
        }
      }
      EXPECT_GT(largest, 0.1);
      EXPECT_GE(inner.size(), 1U);
      for (const auto& [place, force] : inner) EXPECT_LT(force.norm(), 1e-12 * young) << static_cast<int>(shape);
    }
}

/// Bending of a box: the modes give the cell of eight nodes the exact energy.
TEST(Solid, EightNodesBendExactlyInABox) {
  std::vector<Vec3> places = reference_corners(CellShape::hexahedron);
  for (Vec3& x : places) x = Vec3(1.5 * x[0], 0.5 * x[1], 0.4 * x[2]);
  const auto element = cell(CellShape::hexahedron, places, section(true));
  constexpr double curvature = 0.01;
  const StateBuffer state = moved(*element, places, [&](const Vec3& x) {
    // what pure bending with transverse contraction makes of the corners
    return Vec3(-curvature * x[0] * x[1], curvature * (x[0] * x[0] + poisson * (x[1] * x[1] - x[2] * x[2])) / 2,
                curvature * poisson * x[1] * x[2]);
  });
  EXPECT_NEAR(element->energies(state.view()).strain, young * 0.8 / 12 * curvature * curvature * 3 / 2, 1e-13);
}

/// Only rigid motions are free of forces.
TEST(Solid, MechanismsAreCounted) {
  for (const CellShape shape : solids) {
    const auto places = distorted(shape);
    const auto element = cell(shape, places, section(true));
    const auto full = tangent_of(*element, StateBuffer(*element, node_map(places)), {1, 0, 0});
    const auto n = static_cast<Eigen::Index>(3 * places.size());
    const auto slot = [](Eigen::Index i) { return 6 * (i / 3) + i % 3; };
    Eigen::MatrixXd k(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j < n; ++j) k(i, j) = full[static_cast<std::size_t>(slot(i) * 2 * n + slot(j))];
    EXPECT_LT((k - k.transpose()).cwiseAbs().maxCoeff(), 1e-12 * young);
    const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k).eigenvalues();
    const auto free = (values.array() < 1e-9 * values.maxCoeff()).count();
    EXPECT_EQ(free, 6) << places.size() << " nodes";
    EXPECT_GT(values.minCoeff(), -1e-12 * values.maxCoeff());
  }
}

/// Left-handed cells are the same bodies.
TEST(Solid, CornersMayGoRoundEitherWay) {
  const auto places = distorted(CellShape::hexahedron);
  std::vector<Vec3> mirrored;
  for (const int i : {0, 3, 2, 1, 4, 7, 6, 5}) mirrored.push_back(places[static_cast<std::size_t>(i)]);
  const auto bend = [](const Vec3& x) { return Vec3(0.02 * x[1] * x[2], -0.01 * x[0], 0.03 * x[0] * x[1]); };
  const auto a = cell(CellShape::hexahedron, places, section(true)), b = cell(CellShape::hexahedron, mirrored, section(true));
  EXPECT_NEAR(a->energies(moved(*a, places, bend).view()).strain, b->energies(moved(*b, mirrored, bend).view()).strain, 1e-14);
  EXPECT_TRUE(is_regular_solid(CellShape::hexahedron, mirrored));
  std::swap(mirrored[0], mirrored[1]);
  EXPECT_FALSE(is_regular_solid(CellShape::hexahedron, mirrored));
}

/// Faces turn their back on the cell, have four corners at most, and close it: the sum of their areas is nothing.
TEST(Solid, FacesCloseTheCell) {
  for (const CellShape shape : solids) {
    const auto places = distorted(shape, true);
    Vec3 middle = Vec3::Zero(), sum = Vec3::Zero();
    const int corners = corner_count(shape);
    for (int i = 0; i < corners; ++i) middle += places[static_cast<std::size_t>(i)] / corners;
    for (int f = 0; f < face_count(shape); ++f) {
      const std::vector<int> nodes = face_nodes(shape, f);
      const std::size_t count = has_middles(shape) ? nodes.size() / 2 : nodes.size();
      Vec3 area = Vec3::Zero(), centre = Vec3::Zero();
      for (std::size_t i = 0; i < count; ++i) {
        const Vec3& a = places[static_cast<std::size_t>(nodes[i])];
        const Vec3& b = places[static_cast<std::size_t>(nodes[(i + 1) % count])];
        area += a.cross(b) / 2;
        centre += a / static_cast<double>(count);
        if (has_middles(shape)) {
          EXPECT_LT((places[static_cast<std::size_t>(nodes[count + i])] - (a + b) / 2).norm(), 1e-15);
        }
      }
      EXPECT_GT(area.dot(centre - middle), 0) << "face " << f;
      sum += area;
    }
    EXPECT_LT(sum.norm(), 1e-14);
  }
}

/// Uniform warmth makes a free body larger, and nothing else.
TEST(Solid, WarmthAloneMakesNoStress) {
  materials::Elastic material = materials::isotropic(young, poisson);
  material.expansion << 1e-3, 2e-3, -5e-4, 0, 0, 0;
  constexpr double rise = 7;
  for (const CellShape shape : solids) {
    const auto places = distorted(shape);
    const auto element = cell(shape, places, section(true, material), rise);
    const StateBuffer state =
        moved(*element, places, [&](const Vec3& x) { return Vec3(rise * material.expansion.head<3>().cwiseProduct(x)); });
    EXPECT_LT(field_of(*element, state, 0).cwiseAbs().maxCoeff(), 1e-13 * young);
    EXPECT_NEAR(element->energies(state.view()).strain, 0, 1e-15);
  }
}

/// Warm rubber that is free has no stress, however large the growth, and turned as well.
TEST(Solid, WarmRubberGrowsFreely) {
  for (const CellShape shape : solids)
    for (const double growth : {0.4, -0.3}) {
      const auto places = distorted(shape);
      const auto element = cell(shape, places, rubber_section(1e-3), 1e3 * growth);
      const Mat3 turn = (1 + growth) * rotation_exp(Vec3(1.3, -0.8, 2));
      const StateBuffer state = moved(*element, places, [&](const Vec3& x) { return Vec3(turn * x - x); });
      EXPECT_LT(field_of(*element, state, 0).cwiseAbs().maxCoeff(), 1e-12 * young);
      for (const double r : residual_of(*element, state)) EXPECT_NEAR(r, 0, 1e-12 * young);
      EXPECT_NEAR(element->energies(state.view()).strain, 0, 1e-14 * young);
    }
}

/// A material whose axes are turned is the same as a body turned the other way.
TEST(Solid, MaterialsTurn) {
  materials::Elastic material = materials::orthotropic({Vec3(140, 10, 8), Vec3(0.3, 0.4, 0.25), Vec3(5, 3, 6)});
  material.expansion << 1e-3, 2e-3, -5e-4, 0, 0, 0;
  const Mat3 turn = rotation_exp(Vec3(0.4, -0.9, 0.6));
  const auto places = distorted(CellShape::tetrahedron10);
  std::vector<Vec3> turned;
  for (const Vec3& x : places) turned.push_back(turn * x);
  const auto bend = [](const Vec3& x) { return Vec3(0.02 * x[1] * x[2], -0.01 * x[0], 0.03 * x[0] * x[1]); };
  const auto a = cell(CellShape::tetrahedron10, places, section(true, material), 5),
             b = cell(CellShape::tetrahedron10, turned, section(true, materials::turned(material, turn)), 5);
  const double energy = a->energies(moved(*a, places, bend).view()).strain;
  EXPECT_GT(energy, 1e-4);
  EXPECT_NEAR(
      energy,
      b->energies(moved(*b, turned, [&](const Vec3& x) { return Vec3(turn * bend(turn.transpose() * x)); }).view()).strain,
      1e-14);
  EXPECT_FALSE(materials::is_stable(materials::orthotropic({Vec3(1, 1, 1), Vec3(1.2, 0, 0), Vec3(1, 1, 1)})));
}

}  // namespace
}  // namespace engrane::elements::structural
