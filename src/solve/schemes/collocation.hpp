// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Dense>
#include <vector>

namespace engrane::solve {

/// Radau IIA: collocation at the zeros of a Radau polynomial, the last of which is the end of the step (Hairer and Wanner,
/// Solving Ordinary Differential Equations II, 1996, IV.5). With s stages it is of order 2s − 1.
struct Collocation {
  /// One block of the inverse coefficients' real Jordan form, [α −β; β α]; real eigenvalues have β = 0.
  struct Block {
    Eigen::Index first;  ///< its first stage in the transformed variables; a complex one has the next too
    double alpha, beta;
    bool complex() const { return beta != 0; }
  };

  /// `stages`: 2 (order 3) or 3 (order 5).
  static Collocation radau(int stages);

  Eigen::Index stages() const { return c.size(); }
  /// Values at 0, of the polynomial through values at the nodes c, and elsewhere: the weights of these at `s`, a part of the
  /// step.
  Eigen::VectorXd lagrange(double s) const;

  Eigen::VectorXd c;                       ///< nodes, as parts of the step
  Eigen::MatrixXd a;                       ///< increments: Y = h a Ẏ
  Eigen::MatrixXd inverse;                 ///< of a: Ẏ = inverse Y / h
  Eigen::MatrixXd transform, untransform;  ///< inverse = transform · blocks · untransform (the same, IV.8)
  std::vector<Block> blocks;
};

}  // namespace engrane::solve
