// SPDX-License-Identifier: BSD-3-Clause
#include "elements/structural/cell_recovery.hpp"

#include <Eigen/Dense>

#include "elements/structural/cell_topology.hpp"

namespace engrane::elements::structural {

Eigen::MatrixXd extrapolation(CellShape shape, const Eigen::MatrixXd& values) {
  const auto middles = has_middles(shape) ? sides(shape) : std::span<const std::pair<int, int>>{};
  Eigen::MatrixXd to_nodes(values.cols() + static_cast<Eigen::Index>(middles.size()), values.rows());
  to_nodes.topRows(values.cols()) = values.completeOrthogonalDecomposition().pseudoInverse();
  Eigen::Index middle = values.cols();  // the corner functions are linear along sides
  for (const auto& [a, b] : middles) to_nodes.row(middle++) = (to_nodes.row(a) + to_nodes.row(b)) / 2;
  return to_nodes;
}

}  // namespace engrane::elements::structural
