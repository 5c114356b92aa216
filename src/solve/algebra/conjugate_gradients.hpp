// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "solve/algebra/mumps.hpp"

namespace engrane::solve {

/// Conjugate gradients with smoothed aggregation multigrid (PETSc's GAMG), for large symmetric positive definite matrices whose
/// factors would not fit into memory. The matrix needs its near-null space (note_rigid_motions()). A matrix of another kind, or
/// one for which the iteration does not converge, is solved by MUMPS, and so are all later ones.
class ConjugateGradients final : public Factors {
 public:
  explicit ConjugateGradients(Mat matrix);

  /// Sets up the grids.
  bool factor() override;
  std::optional<ForeseenFactors> foresee() override;
  void solve(Vec right, Vec solution) override;
  void solve_transposed(Vec right, Vec solution) override;
  bool direct() const override { return direct_ != nullptr; }
  bool improvable() const override { return !direct_ || direct_->improvable(); }
  bool improve() override;
  void forget() override;
  void save(Snapshot& snapshot) const override;
  void load(const Snapshot& snapshot) override;
  SolverWork work() const override { return direct_ ? direct_->work() : SolverWork{}; }
  /// Memory of MUMPS' factors; 0 for the grids, which do not report theirs.
  double bytes() const override;
  std::string remark() const override { return remark_; }

 private:
  void go_direct(const std::string& why);

  Mat matrix_;
  SymmetryTest symmetry_;
  Owned<KSP> ksp_;
  std::unique_ptr<Mumps> direct_;
  std::string remark_;
};

}  // namespace engrane::solve
