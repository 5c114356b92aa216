// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "solve/algebra/mumps.hpp"

namespace engrane::solve {

/// Conjugate gradients with smoothed aggregation multigrid (PETSc's GAMG) for large symmetric, positive definite matrices, whose
/// factors would not fit into memory. note_rigid_motions() should have told the matrix what its model resists least. A matrix of
/// another kind, and one for which the iteration does not converge, goes to MUMPS, and so do all later ones.
class ConjugateGradients final : public Factors {
 public:
  explicit ConjugateGradients(Mat matrix);

  /// Makes the grids.
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
  /// Of factors; the grids do not tell.
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
