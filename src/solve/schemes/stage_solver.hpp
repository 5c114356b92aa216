// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "assembly/assembler.hpp"
#include "solve/algebra/linear.hpp"
#include "solve/schemes/collocation.hpp"
#include "solve/schemes/stage_matrices.hpp"

namespace engrane::solve {

/// Linear systems of a simplified Newton iteration on all stages of a collocation step (Hairer and Wanner, Solving Ordinary
/// Differential Equations II, 1996, IV.8). With the same K, C and M for all stages they decouple into K + (γ/h) C + (γ/h)² M,
/// one for each eigenvalue γ of the inverse coefficients. A complex γ = α + iβ makes a real system of twice the size, with the
/// real and imaginary parts of an unknown next to each other.
class StageSolver {
 public:
  StageSolver(Assembler& assembler, const Collocation& collocation, const std::string& package);

  /// Weights of the first system, which may be complex: then those of its real part.
  Weights weights(double h) const;
  /// The real eigenvalue γ: in its system, velocities change by γ/h times the increments.
  double real_rate() const;
  /// Forms the systems for steps of h from these matrices. No element is evaluated.
  void combine(const StageMatrices& matrices, double h);
  /// Finds the changes of all stages' unknowns that bring the residuals to zero, one vector for each stage; false if singular.
  bool solve(const std::vector<Owned<Vec>>& residuals, const std::vector<Owned<Vec>>& changes);
  /// Solves the system of the real eigenvalue alone, with its present factors. The residual is overwritten.
  bool solve_real(Vec residual, Vec change);
  /// State of the linear solvers, for a restart.
  void save(Snapshot& snapshot) const;
  void load(const Snapshot& snapshot);
  /// Factors the matrices as they stand in the same way as the run that load() continues.
  void restore_factors();

 private:
  /// One block of the collocation.
  struct System {
    Collocation::Block block;
    Owned<Mat> whole;
    std::unique_ptr<LinearSolver> solver;
    Owned<Vec> right, solution;  ///< of a complex block
  };
  /// That of the real eigenvalue, which collocation with an odd number of stages has.
  const System& real() const;
  /// [Re −Im; Im Re] with rows and columns 2i and 2i + 1 for the two parts of unknown i.
  void combine_pair(const StageMatrices& matrices, double h, const System& system) const;

  Assembler& assembler_;
  const Collocation& collocation_;
  std::vector<System> systems_;
  std::vector<Owned<Vec>> transformed_, solved_;
};

}  // namespace engrane::solve
