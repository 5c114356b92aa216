// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Dense>

#include "elements/structural/cell_shapes.hpp"
#include "elements/structural/cell_topology.hpp"

namespace engrane::elements::structural {

/// The cell with the same corners and without mid-side nodes.
constexpr CellShape without_middles(CellShape shape) {
  switch (shape) {
    case CellShape::triangle6:
      return CellShape::triangle;
    case CellShape::quadrilateral8:
      return CellShape::quadrilateral;
    case CellShape::tetrahedron10:
      return CellShape::tetrahedron;
    case CellShape::wedge15:
      return CellShape::wedge;
    case CellShape::hexahedron20:
      return CellShape::hexahedron;
    default:
      return shape;
  }
}

/// From values at points of a cell to those at its nodes (nodes × points): the combination of the shape functions of its corners
/// that is nearest to the values at the points, least squares. Of several such combinations, where there are fewer points than
/// corners, the one with the smallest values at the corners; a single point gives its value to all nodes.
template <CellShape S>
Eigen::MatrixXd extrapolation(const QuadratureRule& points) {
  constexpr CellShape base = without_middles(S);
  constexpr Eigen::Index corners = CellTraits<base>::nodes;
  Eigen::MatrixXd values(static_cast<Eigen::Index>(points.size()), corners);
  for (Eigen::Index i = 0; i < values.rows(); ++i)
    values.row(i) = CellTraits<base>::sample(points[static_cast<std::size_t>(i)]).value.transpose();
  Eigen::MatrixXd to_nodes(CellTraits<S>::nodes, values.rows());
  to_nodes.topRows(corners) = values.completeOrthogonalDecomposition().pseudoInverse();
  // along a side these functions are linear
  if constexpr (base != S) {
    Eigen::Index middle = corners;
    for (const auto& [a, b] : sides(S)) to_nodes.row(middle++) = (to_nodes.row(a) + to_nodes.row(b)) / 2;
  }
  return to_nodes;
}

}  // namespace engrane::elements::structural
