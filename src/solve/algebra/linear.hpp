// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "solve/algebra/gathered_system.hpp"
#include "solve/algebra/judged_factors.hpp"
#include "solve/algebra/solver_cost.hpp"

namespace engrane::solve {

/// A solver on one matrix whose pattern never changes: the symbolic analysis is done once. To PETSc it is a preconditioner
/// (PCSHELL). Its solutions are judged (JudgedFactors). A small matrix of several ranks is solved by the first of them
/// (GatheredSystem).
class LinearSolver {
 public:
  /// `package` as in the deck: AUTO, MUMPS, KLU, UMFPACK, SUPERLU, CG. A matrix that several ranks factor together is factored by
  /// MUMPS unless CG is wanted.
  /// `kinds`: what each row is (BackwardError).
  LinearSolver(Mat matrix, const std::string& package, const std::vector<unsigned char>& kinds = {});
  LinearSolver(const LinearSolver&) = delete;
  LinearSolver& operator=(const LinearSolver&) = delete;

  KSP ksp() const { return ksp_; }
  const std::string& package() const { return package_; }
  /// Whether solutions are those of factors (Factors::direct()).
  bool direct() const { return gathered_ || factors_->package().direct(); }

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
  std::optional<ForeseenFactors> foresee();

  /// Forgets the analysis, which looks at numbers too: after a failure, or before matrices of another kind.
  void reset();

  /// What the next solution owes to earlier ones, as the first rank keeps it for all.
  void save(Snapshot& snapshot) const;
  void load(const Snapshot& snapshot);
  /// The matrix whose factors go on to serve, as it stands, where one rank has all of it.
  void save_factors(Snapshot& snapshot) const;
  /// Takes it back, after load(), and factors it; false where there is none.
  bool load_factors(const Snapshot& snapshot);
  /// Factors the matrix as it stands as the run did that load() has taken over from.
  void restore_factors();

  /// Factors::remark(), on the first rank.
  std::string remark() const { return factors_ ? factors_->package().remark() : std::string(); }
  /// What a factorisation and a solution cost.
  SolverWork work() const { return gathered_ ? work_ : factors_->package().work(); }
  /// What KLU and MUMPS cost for this matrix; on one rank.
  ForeseenWork foreseen() const { return foresee_work(matrix_); }
  /// Memory of the factors in bytes, as the package reports it; 0 when it does not. On the first rank.
  double factor_bytes() const { return factors_ ? factors_->package().bytes() : 0; }

  /// Condition of the matrix that was factored last, in the norm of the largest sum of a column: an estimate from its factors.
  /// Nothing where there are none. Collective; known on the first rank.
  std::optional<double> condition();
  /// Backward error of the last solution that was looked at; on the first rank.
  double backward_error() const { return factors_ ? factors_->backward_error() : 0; }

 private:
  static PetscErrorCode set_up(PC pc);
  static PetscErrorCode apply(PC pc, Vec right, Vec solution);
  /// The matrix that is factored; null on ranks that wait.
  Mat factored() const { return gathered_ ? gathered_->matrix() : matrix_; }
  bool factor();
  bool solve_with_factors(Vec right, Vec solution);
  /// Those of factored(), as the run had them that load() has taken over from.
  void make_factors_again();
  /// Does what tells whether the matrix is regular, on the ranks that factor, and tells all. What it throws is thrown on all.
  template <class Act>
  bool agree(const Act& act);

  Mat matrix_;
  std::string package_;
  std::unique_ptr<GatheredSystem> gathered_;  ///< null where each rank factors its part
  std::unique_ptr<JudgedFactors> factors_;    ///< null on ranks that wait for the first one
  Owned<KSP> ksp_;
  SolverWork work_;             ///< of the first rank's factors, known to all
  bool proven_before_ = false;  ///< JudgedFactors::proven() of the run that load() has taken over from
  bool resumable_ = true;       ///< what load() was given is of as many ranks
  bool restored_ = false;       ///< the factors are those of make_factors_again()
  std::exception_ptr failure_;  ///< to be thrown once PETSc has been left
  PetscLogEvent factoring_ = -1, solving_ = -1;
};

}  // namespace engrane::solve
