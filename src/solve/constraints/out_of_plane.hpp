// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <vector>

#include "assembly/assembler.hpp"

namespace engrane::solve {

/// What joints of a plane model (Model::plane) carry out of the plane: the multipliers without equation. The motion does not
/// depend on them, so they are found only for results.
class OutOfPlane {
 public:
  explicit OutOfPlane(Assembler& assembler);

  /// Whether anything is carried out of the plane; otherwise these multipliers are zero.
  bool active() const { return !slots_.empty(); }
  /// Gives the multipliers left out the least values, forces as they are and moments over the extent in the mean square, that
  /// balance the forces and moments out of the plane. Not collective: every rank finds the same.
  void find(Configuration& c);

 private:
  Assembler& assembler_;
  std::vector<int> slots_, row_;  ///< unknown in space only, and the row of every slot of a node; -1: none
  std::vector<int> multipliers_, column_;
  std::vector<bool> holds_;  ///< by part: it has such multipliers
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors_;
};

}  // namespace engrane::solve
