// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Dense>
#include <vector>

namespace engrane::solve {

/// Collocation at given instants of a step: all of the scheme that depends on where these are.
struct Collocation {
  /// One block of the real Jordan form of the inverse coefficients, [α −β; β α]; β = 0 for a real eigenvalue.
  struct Block {
    Eigen::Index first;  ///< its first transformed stage; a complex block has the next one too
    double alpha, beta;
    bool complex() const { return beta != 0; }
  };

  /// Radau IIA with three stages, the last at the end of the step: order 5, stiffly accurate, damps everything much faster than
  /// the step (Hairer and Wanner, Solving Ordinary Differential Equations II, 1996, IV.5).
  static Collocation radau();

  Eigen::Index stages() const { return c.size(); }
  Eigen::VectorXd c;                       ///< nodes, as fractions of the step
  Eigen::MatrixXd a;                       ///< increments: Y = h a Ẏ
  Eigen::MatrixXd inverse;                 ///< of a: Ẏ = inverse Y / h
  Eigen::MatrixXd transform, untransform;  ///< inverse = transform · blocks · untransform (the same, IV.8)
  std::vector<Block> blocks;
  /// Embedded formula of order s (the number of stages) that also uses the beginning of the step, minus this scheme: the local
  /// error of a step is about embedded_first h ẏ_0 + embedded · y, with the increments y of the stages (the same, IV.8).
  double embedded_first = 0;
  Eigen::VectorXd embedded;
};

}  // namespace engrane::solve
