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

/// Linear solver for one matrix with a fixed sparsity pattern, so that the symbolic analysis is done once. To PETSc it is a
/// preconditioner (PCSHELL). Its solutions are checked (JudgedFactors). A small matrix on several ranks is solved by the first
/// of them (GatheredSystem).
class LinearSolver {
 public:
  /// `package` as in the deck: AUTO, MUMPS, KLU, UMFPACK, SUPERLU, CG. A matrix that several ranks factor together is factored
  /// by MUMPS unless CG is wanted. `kinds`: kind of each row (BackwardError).
  LinearSolver(Mat matrix, const std::string& package, const std::vector<unsigned char>& kinds = {});
  LinearSolver(const LinearSolver&) = delete;
  LinearSolver& operator=(const LinearSolver&) = delete;

  KSP ksp() const { return ksp_; }
  const std::string& package() const { return package_; }
  /// Whether solutions come from factors (Factors::direct()).
  bool direct() const { return gathered_ || factors_->package().direct(); }

  /// Called once, before the first factorisation, with its predicted cost; set on every rank or on none.
  std::function<void(const ForeseenFactors&)> announce;

  /// Factors the matrix as it stands and solves; false when it is singular to working precision. Throws MemoryShortage.
  bool solve(Vec right, Vec solution);

  /// Whether the next solutions are corrections with the factors of another tangent. These need not be as good as rounding
  /// allows, since the difference of the tangents determines what the iteration leaves of a residual: fair_solution is enough,
  /// and after the first solution that is as good the others are not checked.
  void correct_only(bool corrections);

  /// Rethrows the exception that ended a solution within PETSc, if any.
  void rethrow();

  /// Predicted cost of factors of the matrix as it stands, without making them; nothing if the package does not predict it.
  std::optional<ForeseenFactors> foresee();

  /// Discards the analysis, which depends on the values too: after a failure, or before matrices of another kind.
  void reset();

  /// State that later solutions depend on; the first rank keeps it for all.
  void save(Snapshot& snapshot) const;
  void load(const Snapshot& snapshot);
  /// Saves the matrix whose factors remain in use, as it stands, if one rank has all of it.
  void save_factors(Snapshot& snapshot) const;
  /// Restores that matrix, after load(), and factors it; false if there is none.
  bool load_factors(const Snapshot& snapshot);
  /// Factors the matrix as it stands in the same way as the run that load() continues.
  void restore_factors();

  /// Factors::remark(), on the first rank.
  std::string remark() const { return factors_ ? factors_->package().remark() : std::string(); }
  /// Cost of a factorisation and a solution.
  SolverWork work() const { return gathered_ ? work_ : factors_->package().work(); }
  /// Predicted cost of KLU and MUMPS for this matrix; on one rank.
  ForeseenWork foreseen() const { return foresee_work(matrix_); }
  /// Memory of the factors in bytes, as the package reports it; 0 when it does not. On the first rank.
  double factor_bytes() const { return factors_ ? factors_->package().bytes() : 0; }

  /// Condition number in the 1-norm (largest column sum) of the matrix that was factored last, estimated from its factors;
  /// nothing if there are none. Collective; known on the first rank.
  std::optional<double> condition();
  /// Backward error of the last solution that was checked; on the first rank.
  double backward_error() const { return factors_ ? factors_->backward_error() : 0; }

 private:
  static PetscErrorCode set_up(PC pc);
  static PetscErrorCode apply(PC pc, Vec right, Vec solution);
  /// The matrix that is factored; null on ranks that wait.
  Mat factored() const { return gathered_ ? gathered_->matrix() : matrix_; }
  bool factor();
  bool solve_with_factors(Vec right, Vec solution);
  /// Factors factored() in the same way as the run that load() continues.
  void make_factors_again();
  /// Calls `act`, which returns whether the matrix is regular, on the ranks that factor, and returns its result on all. What it
  /// throws is thrown on all.
  template <class Act>
  bool agree(const Act& act);

  Mat matrix_;
  std::string package_;
  std::unique_ptr<GatheredSystem> gathered_;  ///< null where each rank factors its part
  std::unique_ptr<JudgedFactors> factors_;    ///< null on ranks that wait for the first one
  Owned<KSP> ksp_;
  SolverWork work_;             ///< of the first rank's factors, known to all
  bool proven_before_ = false;  ///< JudgedFactors::proven() of the run that load() continues
  bool resumable_ = true;       ///< the state given to load() is of as many ranks
  bool restored_ = false;       ///< the factors are those of make_factors_again()
  std::exception_ptr failure_;  ///< to be thrown once PETSc has been left
  PetscLogEvent factoring_ = -1, solving_ = -1;
};

}  // namespace engrane::solve
