// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "solve/algebra/mumps.hpp"

namespace engrane::solve {

/// Conjugate gradients with smoothed aggregation multigrid (PETSc's GAMG), for large symmetric positive definite matrices whose
/// factors would not fit into memory. The matrix needs its near-null space (note_rigid_motions()). A matrix of another kind, or
/// one for which the iteration does not converge, is solved by MUMPS. The next matrix may again be one for the iteration, which
/// is given up for good only after several failures in a row.
class ConjugateGradients final : public Factors {
 public:
  explicit ConjugateGradients(Mat matrix) : matrix_(matrix), symmetry_(matrix) {}

  /// Sets up the grids.
  bool factor() override;
  std::optional<ForeseenFactors> foresee() override;
  /// A solution for which the iteration fails is one of MUMPS; not finite if the matrix is singular.
  void solve(Vec right, Vec solution) override;
  void solve_transposed(Vec right, Vec solution) override;
  bool direct() const override { return direct_ != nullptr; }
  bool improvable() const override { return !direct_ || direct_->improvable(); }
  /// The next solve(), of the same system, continues from the solution that was not good enough.
  bool improve() override;
  void forget() override;
  void save(Snapshot& snapshot) const override;
  void load(const Snapshot& snapshot) override;
  SolverWork work() const override { return direct_ ? direct_->work() : SolverWork{}; }
  /// Memory of MUMPS' factors; 0 for the grids, which do not report theirs.
  double bytes() const override;
  std::string remark() const override;

 private:
  enum class Preconditioner : unsigned char { multigrid, diagonal };

  void set_up(Preconditioner preconditioner);
  /// Whether the iteration converges; if not, why_ says what happened.
  bool iterate(Vec right, Vec solution);
  /// Factors the matrix by MUMPS; false if it is singular.
  bool factor_directly();

  Mat matrix_;
  SymmetryTest symmetry_;
  Owned<KSP> ksp_;
  std::unique_ptr<Mumps> direct_;  ///< of the present matrix, if the iteration does not solve it
  bool continues_ = false;         ///< the next solution starts from the last one
  int failures_ = 0;               ///< matrices in a row for which the iteration did not converge
  int matrices_ = 0, left_ = 0;    ///< how many there were, and how many of them were left to MUMPS
  std::string why_;                ///< the last of these was
};

}  // namespace engrane::solve
