// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "assembly/petsc.hpp"
#include "base/snapshot.hpp"

namespace engrane::solve {

/// Cost of a factorisation and of a solution, in instructions: counted, so the same in every run.
struct SolverWork {
  double factor = 0, solution = 0;
};

/// Predicted cost of a factorisation, from its analysis: memory in bytes on all ranks, and floating-point operations.
struct ForeseenFactors {
  double bytes = 0, operations = 0;
};

/// There is not enough memory; the message is for the user.
struct MemoryShortage : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Factors of one matrix with a fixed sparsity pattern, by one package: a rung of the solver ladder. A package factors and
/// solves. Whether a solution is good enough, and what to do if it is not, is decided for all packages by JudgedFactors.
class Factors {
 public:
  Factors() = default;
  virtual ~Factors() = default;
  Factors(const Factors&) = delete;
  Factors& operator=(const Factors&) = delete;

  /// Factors the matrix as it stands; false if it is singular. Throws MemoryShortage before it takes more memory than there is.
  virtual bool factor() = 0;
  /// Chooses the elimination order, unless that is done, and returns the predicted cost of factor(); nothing if the package
  /// does not predict it. Collective.
  virtual std::optional<ForeseenFactors> foresee() { return {}; }
  virtual void solve(Vec right, Vec solution) = 0;
  virtual void solve_transposed(Vec right, Vec solution) = 0;

  /// True if solutions come from factors, so that their errors are rounding errors; false for an iteration to a tolerance.
  virtual bool direct() const { return true; }

  /// Whether the package can factor the matrix more carefully than it has.
  virtual bool improvable() const { return false; }
  /// Factors it more carefully, and later matrices too as long as that pays; false if the matrix is singular.
  virtual bool improve() { return false; }
  /// A solution was good enough without improve().
  virtual void served() {}
  /// Discards the analysis, which depends on the values too.
  virtual void forget() = 0;

  /// State that later solutions depend on, on one rank; on several ranks the analysis is repeated.
  virtual void save(Snapshot& snapshot) const = 0;
  virtual void load(const Snapshot& snapshot) = 0;
  /// Factors the matrix as it stands in the same way as the run that load() continues; false if it is singular.
  virtual bool restore() { return factor(); }

  /// A note for the user on how the matrix was solved; empty if there is nothing to say.
  virtual std::string remark() const { return {}; }
  virtual SolverWork work() const = 0;
  /// Memory of the factors as the package reports it; 0 when it does not.
  virtual double bytes() const = 0;
};

/// `package` as in the deck: MUMPS, BLR, KLU, UMFPACK, SUPERLU, CG; for a matrix on several ranks, MUMPS, BLR or CG.
std::unique_ptr<Factors> make_factors(Mat matrix, const std::string& package);

}  // namespace engrane::solve
