// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "solve/algebra/backward_error.hpp"
#include "solve/algebra/factors.hpp"
#include "solve/algebra/solver_cost.hpp"

namespace engrane::solve {

/// A solver on one matrix whose pattern never changes: the symbolic analysis is done once. To PETSc it is a preconditioner
/// (PCSHELL).
///
/// The first solution with each factorisation is judged by its backward error (BackwardError), refined where that helps and found
/// with better factors where it does not; the others too, unless the first was as good as it can be.
class LinearSolver {
 public:
  /// `package` as in the deck: AUTO, MUMPS, KLU, UMFPACK, SUPERLU, CG. On several ranks MUMPS is taken unless CG is wanted.
  /// `kinds`: what each row is (BackwardError).
  LinearSolver(Mat matrix, const std::string& package, const std::vector<unsigned char>& kinds = {});
  LinearSolver(const LinearSolver&) = delete;
  LinearSolver& operator=(const LinearSolver&) = delete;

  KSP ksp() const { return ksp_; }
  const std::string& package() const { return package_; }
  /// Factors::direct()
  bool direct() const { return factors_->direct(); }

  /// Called once, before the first factorisation, with what the package foresees of it; set on every rank or on none.
  std::function<void(const ForeseenFactors&)> announce;

  /// Factors the matrix as it stands and solves; false when it is singular to working precision. Throws MemoryShortage.
  bool solve(Vec right, Vec solution);

  /// Whether the next solutions are corrections with factors of another tangent. Those need not be as good as rounding allows:
  /// what an iteration leaves of a residual is then the difference of the tangents. No refinement, no look at those after a first
  /// good one.
  void correct_only(bool corrections);

  /// Throws what ended a solution within PETSc; nothing where nothing did.
  void rethrow();

  /// What factors of the matrix as it stands will take, without making them; nothing where the package does not tell.
  std::optional<ForeseenFactors> foresee() { return factors_->foresee(); }

  /// Forgets the analysis, which looks at numbers too: after a failure, or before matrices of another kind.
  void reset();

  /// What the next solution owes to earlier ones.
  void save(Snapshot& snapshot) const;
  void load(const Snapshot& snapshot);
  /// The matrix whose factors go on to serve, as it stands; on one rank.
  void save_factors(Snapshot& snapshot) const;
  /// Takes it back, after load(), and factors it; false where there is none.
  bool load_factors(const Snapshot& snapshot);
  /// Factors the matrix as it stands as the run did that load() has taken over from.
  void restore_factors();

  /// Factors::remark().
  std::string remark() const { return factors_->remark(); }
  /// What a factorisation and a solution cost.
  SolverWork work() const { return factors_->work(); }
  /// What KLU and MUMPS cost for this matrix; on one rank.
  ForeseenWork foreseen() const { return foresee_work(matrix_); }
  /// Memory of the factors in bytes, as the package reports it; 0 when it does not.
  double factor_bytes() const { return factors_->bytes(); }

  /// Condition of the matrix that was factored last, in the norm of the largest sum of a column: an estimate from its factors.
  /// Nothing where there are none. Collective.
  std::optional<double> condition();
  /// Backward error of the last solution that was looked at.
  double backward_error() const { return error_; }

 private:
  static PetscErrorCode set_up(PC pc);
  static PetscErrorCode apply(PC pc, Vec right, Vec solution);
  /// The matrix as it stands; false where it is singular.
  bool factor();
  void solve_well(Vec right, Vec solution);
  /// Solves, refines once where the backward error asks for it, and notes the backward error.
  void solve_and_refine(Vec right, Vec solution);

  Mat matrix_;
  std::string package_;
  std::unique_ptr<Factors> factors_;
  BackwardError backward_error_;
  Owned<Vec> correction_;
  Owned<KSP> ksp_;
  enum class State { forgotten, ready, singular } state_ = State::forgotten;  ///< the factors are
  bool proven_ = false;            ///< a solution with these factors was good enough at once
  bool proven_before_ = false;     ///< proven_ of the run that load() has taken over from
  bool restored_ = false;          ///< the factors are those of restore_factors()
  double enough_ = good_solution;  ///< backward error of such a solution
  double error_ = 0;
  std::exception_ptr failure_;  ///< to be thrown once PETSc has been left
  PetscLogEvent factoring_ = -1, solving_ = -1;
};

}  // namespace engrane::solve
