// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <vector>

#include "assembly/assembler.hpp"

namespace engrane::solve {

/// Reactions out of the plane in the joints of a plane model (Model::plane): the multipliers without equation. The motion does
/// not depend on them, so they are found only for results.
class OutOfPlane {
 public:
  explicit OutOfPlane(Assembler& assembler);

  /// Returns the configuration with the multipliers left out set to the smallest values (forces as they are, moments over the
  /// extent, in the mean square) that balance the forces and moments out of the plane. If nothing is carried out of the plane,
  /// they are zero: returns `c` itself. The result is valid until the next call. Not collective: every rank finds the same.
  const Configuration& completed(const Configuration& c);

 private:
  void find(Configuration& c);

  Assembler& assembler_;
  std::vector<int> slots_, row_;  ///< slots unknown in space only, and the row of every motion slot; -1: none
  std::vector<int> multipliers_, column_;
  std::vector<bool> holds_;  ///< of each part: whether it has such multipliers
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors_;
  Configuration completed_;
};

}  // namespace engrane::solve
