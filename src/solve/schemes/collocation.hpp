// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Dense>
#include <vector>

namespace engrane::solve {

/// Collocation at some instants of a step: all of the scheme that depends on where these are.
struct Collocation {
  /// One block of the inverse coefficients' real Jordan form, [α −β; β α]; real eigenvalues have β = 0.
  struct Block {
    Eigen::Index first;  ///< its first stage in the transformed variables; a complex one has the next too
    double alpha, beta;
    bool complex() const { return beta != 0; }
  };

  /// Radau IIA of three stages, the last at the end of the step: order 5, stiffly accurate, damps all that is much faster than
  /// the step (Hairer and Wanner, Solving Ordinary Differential Equations II, 1996, IV.5).
  static Collocation radau();

  Eigen::Index stages() const { return c.size(); }
  Eigen::VectorXd c;                       ///< nodes, as parts of the step
  Eigen::MatrixXd a;                       ///< increments: Y = h a Ẏ
  Eigen::MatrixXd inverse;                 ///< of a: Ẏ = inverse Y / h
  Eigen::MatrixXd transform, untransform;  ///< inverse = transform · blocks · untransform (the same, IV.8)
  std::vector<Block> blocks;
  /// A formula of one order more than stages would have from the beginning too, less this one: the local error of a step is about
  /// embedded_first h ẏ_0 + embedded · y, with the increments y of the stages (the same, IV.8).
  double embedded_first = 0;
  Eigen::VectorXd embedded;
};

}  // namespace engrane::solve
