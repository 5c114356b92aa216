// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "elements/structural/cell_shapes.hpp"

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

/// Matrix (nodes × points) that extrapolates values at the points of a cell to its nodes: least-squares fit by the shape
/// functions of the corners. With fewer points than corners it is the minimum-norm fit, so that a single point gives its value
/// to all nodes. `values`: these shape functions at the points (points × corners).
Eigen::MatrixXd extrapolation(CellShape shape, const Eigen::MatrixXd& values);

template <CellShape S>
Eigen::MatrixXd extrapolation(const QuadratureRule& points) {
  using Base = CellTraits<without_middles(S)>;
  Eigen::MatrixXd values(static_cast<Eigen::Index>(points.size()), Base::nodes);
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    const auto sample = Base::sample(points[static_cast<std::size_t>(i)]);
    for (Eigen::Index j = 0; j < values.cols(); ++j) values(i, j) = sample.value[j];
  }
  return extrapolation(S, values);
}

}  // namespace engrane::elements::structural
