// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "assembly/assembler.hpp"
#include "solve/algebra/linear.hpp"
#include "solve/schemes/collocation.hpp"
#include "solve/schemes/stage_matrices.hpp"

namespace engrane::solve {

/// The linear systems of a simplified Newton iteration on all stages of a collocation step (Hairer and Wanner, Solving Ordinary
/// Differential Equations II, 1996, IV.8). With one K, C and M for all stages they fall apart into K + (γ/h) C + (γ/h)² M, one
/// for each eigenvalue γ of the inverse coefficients. A complex γ = α + iβ makes a real system of twice the size, real and
/// imaginary parts of an unknown next to each other.
class StageSolver {
 public:
  StageSolver(Assembler& assembler, const Collocation& collocation, const std::string& package);

  /// The weights of the real eigenvalue, or of the real part of the complex one where there is no real one.
  Weights weights(double h) const;
  /// γ of the real eigenvalue: increments over γ/h and velocities of its system go together.
  double real_rate() const;
  /// The systems for steps of h with these. No element is evaluated.
  void combine(const StageMatrices& matrices, double h);
  /// Changes of all stages' unknowns that bring the residuals, one vector for each stage, to zero; false when singular. Residuals
  /// are overwritten.
  bool solve(const std::vector<Owned<Vec>>& residuals, const std::vector<Owned<Vec>>& changes);
  /// The same for the system of the real eigenvalue alone, with its factors as they are.
  bool solve_real(Vec residual, Vec change);
  /// What the analyses were made for, for a restart.
  void save(Snapshot& snapshot) const;
  void load(const Snapshot& snapshot);
  /// Factors the matrices as they stand as the run did that load() has taken over from.
  void restore_factors();

 private:
  /// One block of the collocation.
  struct System {
    Collocation::Block block;
    Owned<Mat> whole;
    std::unique_ptr<LinearSolver> solver;
    Owned<Vec> right, solution;  ///< of a complex one
  };
  /// That of the real eigenvalue: collocation with an odd number of stages has one.
  const System& real() const;
  /// [Re −Im; Im Re] with rows and columns 2i and 2i + 1 for the two parts of unknown i.
  void combine_pair(const StageMatrices& matrices, double h, const System& system) const;

  Assembler& assembler_;
  const Collocation& collocation_;
  std::vector<System> systems_;
  std::vector<Owned<Vec>> transformed_, solved_;
};

}  // namespace engrane::solve
