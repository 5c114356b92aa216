// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "assembly/assembler.hpp"
#include "math/vector.hpp"
#include "solve/algebra/linear.hpp"
#include "solve/schemes/collocation.hpp"
#include "solve/schemes/stage_matrices.hpp"

namespace engrane::solve {

/// Linear systems of Newton's iteration on all stages of a collocation step, each stage with the tangents of its own
/// configuration (Hairer and Wanner, Solving Ordinary Differential Equations II, 1996, IV.8). With increments y_i, velocities
/// v_i = T(y_i) Σ_j (A⁻¹)_ij y_j/h and accelerations a_i = Σ_j (A⁻¹)_ij (v_j − v_0)/h the change of y_j enters the balance of
/// stage i by δ_ij K_i + C_i ∂v_i/∂y_j + M_i ∂a_i/∂y_j, so that convergence is quadratic. It costs several times as much as
/// StageSolver and is used where that does not converge: where tangents differ much along a step, and where constraints lose
/// rank within it and are then closed by corrections of the opposite sign.
class CoupledStages {
 public:
  CoupledStages(Assembler& assembler, const Collocation& collocation, const std::string& package);

  /// Call before the first solution of a step. Nothing is kept from other steps, so that a continued run gives the same bits.
  void begin();
  /// Finds the changes of all stages' unknowns that bring the residuals to zero, one vector for each stage, for a step of h
  /// with stages at `places`, `increments` (by motion slot) from its beginning; false if singular.
  bool solve(const std::vector<Configuration>& places, const std::vector<std::vector<double>>& increments, double h,
             const std::vector<Owned<Vec>>& residuals, const std::vector<Owned<Vec>>& changes);
  /// Matrices of each stage at the last solution.
  const std::vector<StageMatrices>& matrices() const { return matrices_; }

 private:
  /// ∂v_i/∂y_j and ∂a_i/∂y_j of a node's rotation, at i · stages + j.
  struct Rates {
    std::vector<Mat3> velocity, acceleration;
  };
  std::vector<Rates> rates_of_rotations(const std::vector<std::vector<double>>& increments, double h) const;
  void assemble(const std::vector<Configuration>& places, const std::vector<Rates>& rotations, double h);

  Assembler& assembler_;
  const Collocation& collocation_;
  std::string package_;
  std::vector<unsigned char> kinds_;  ///< of the rows
  std::vector<StageMatrices> matrices_;
  Owned<Mat> whole_;
  std::unique_ptr<LinearSolver> solver_;
  Owned<Vec> right_, solution_;
};

}  // namespace engrane::solve
