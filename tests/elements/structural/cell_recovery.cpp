// SPDX-License-Identifier: BSD-3-Clause
#include "elements/structural/cell_recovery.hpp"

#include <gtest/gtest.h>

#include "elements/structural/cell_topology.hpp"

namespace engrane::elements::structural {
namespace {

/// Places of the nodes of a reference cell: its corners as `at` has them, then the middles of its sides.
template <CellShape S>
std::vector<QuadraturePoint> nodes(std::vector<QuadraturePoint> at) {
  if (static_cast<std::size_t>(CellTraits<S>::nodes) > at.size())
    for (const auto& [a, b] : sides(S)) {
      const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
      at.push_back({(at[i].xi + at[j].xi) / 2, (at[i].eta + at[j].eta) / 2, 0, (at[i].zeta + at[j].zeta) / 2});
    }
  return at;
}

double linear(const QuadraturePoint& p) { return 0.7 - 1.3 * p.xi + 2.1 * p.eta + 0.4 * p.zeta; }
double bilinear(const QuadraturePoint& p) { return linear(p) + 0.9 * p.xi * p.eta; }
double trilinear(const QuadraturePoint& p) {
  return bilinear(p) - 0.6 * p.eta * p.zeta + 1.1 * p.zeta * p.xi + 0.8 * p.xi * p.eta * p.zeta;
}
double constant(const QuadraturePoint&) { return 0.7; }
/// Linear in the triangle of a wedge, and along it.
double product(const QuadraturePoint& p) { return (0.7 - 1.3 * p.xi + 2.1 * p.eta) * (1 + 0.5 * p.zeta); }

template <CellShape S>
void expect_exact(const QuadratureRule& points, const std::vector<QuadraturePoint>& corners,
                  double (*function)(const QuadraturePoint&)) {
  const Eigen::MatrixXd matrix = extrapolation<S>(points);
  Eigen::VectorXd values(static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) values[static_cast<Eigen::Index>(i)] = function(points[i]);
  const Eigen::VectorXd found = matrix * values;
  const auto at = nodes<S>(corners);
  ASSERT_EQ(found.size(), static_cast<Eigen::Index>(at.size()));
  for (std::size_t i = 0; i < at.size(); ++i) EXPECT_NEAR(found[static_cast<Eigen::Index>(i)], function(at[i]), 1e-13);
}

const std::vector<QuadraturePoint> of_triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
    of_square{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, of_tetrahedron{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0, 1}},
    of_wedge{{0, 0, 0, -1}, {1, 0, 0, -1}, {0, 1, 0, -1}, {0, 0, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}},
    of_cube{{-1, -1, 0, -1}, {1, -1, 0, -1}, {1, 1, 0, -1}, {-1, 1, 0, -1},
            {-1, -1, 0, 1},  {1, -1, 0, 1},  {1, 1, 0, 1},  {-1, 1, 0, 1}};

/// What the functions of the corners can be is extrapolated exactly, to the middles of sides too.
TEST(CellRecovery, ExtrapolatesTheFunctionsOfTheCorners) {
  using S = CellShape;
  expect_exact<S::triangle>(CellTraits<CellShape::triangle>::stiffness_points(), of_triangle, constant);
  expect_exact<S::triangle6>(CellTraits<S::triangle6>::stiffness_points(), of_triangle, linear);
  expect_exact<S::quadrilateral>(CellTraits<S::quadrilateral>::stiffness_points(), of_square, bilinear);
  expect_exact<S::quadrilateral8>(CellTraits<S::quadrilateral8>::stiffness_points(), of_square, bilinear);
  expect_exact<S::tetrahedron>(CellTraits<CellShape::tetrahedron>::stiffness_points(), of_tetrahedron, constant);
  expect_exact<S::tetrahedron10>(CellTraits<S::tetrahedron10>::stiffness_points(), of_tetrahedron, linear);
  expect_exact<S::wedge>(CellTraits<CellShape::wedge>::stiffness_points(), of_wedge, product);
  expect_exact<S::wedge15>(CellTraits<S::wedge15>::stiffness_points(), of_wedge, product);
  expect_exact<S::hexahedron>(CellTraits<S::hexahedron>::stiffness_points(), of_cube, trilinear);
  expect_exact<S::hexahedron20>(*CellTraits<S::hexahedron20>::result_points(), of_cube, trilinear);
}

/// With more points than functions the nearest is taken: what no function can be leaves no trace where it is orthogonal to them.
TEST(CellRecovery, IsOfLeastSquares) {
  const QuadratureRule& points = CellTraits<CellShape::wedge15>::stiffness_points();
  Eigen::VectorXd values(static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)  // its mean over the three heights is zero, and it is even in ζ
    values[static_cast<Eigen::Index>(i)] = points[i].zeta * points[i].zeta - 0.4;
  EXPECT_LT((extrapolation<CellShape::wedge15>(points) * values).norm(), 1e-13);
}

}  // namespace
}  // namespace engrane::elements::structural
