// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "assembly/petsc.hpp"
#include "base/snapshot.hpp"

namespace engrane::solve {

/// What a factorisation and a solution cost, in instructions: counted, so the same in every run.
struct SolverWork {
  double factor = 0, solution = 0;
};

/// What factors will take, as their analysis foretells: bytes on all ranks, operations with floating-point numbers.
struct ForeseenFactors {
  double bytes = 0, operations = 0;
};

/// There is not enough memory for what was asked for; the text is for the user.
struct MemoryShortage : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The factors of one matrix whose pattern never changes, by one package: a rung of the solver ladder. A package factors and
/// solves; whether a solution is good enough, and what to do where it is not, LinearSolver decides for all of them.
class Factors {
 public:
  Factors() = default;
  virtual ~Factors() = default;
  Factors(const Factors&) = delete;
  Factors& operator=(const Factors&) = delete;

  /// Of the matrix as it stands; false where it is singular. Throws MemoryShortage before it takes more than there is.
  virtual bool factor() = 0;
  /// Chooses the order of elimination, unless that is done, and tells what factor() will take; nothing where the package does not
  /// tell. Collective.
  virtual std::optional<ForeseenFactors> foresee() { return {}; }
  virtual void solve(Vec right, Vec solution) = 0;
  virtual void solve_transposed(Vec right, Vec solution) = 0;

  /// Whether solutions are those of factors, so that their errors are of rounding; not iterations to a tolerance.
  virtual bool direct() const { return true; }

  /// Whether the package can factor the matrix more carefully than it has.
  virtual bool improvable() const { return false; }
  /// Does so, and goes on so as long as that is wise; false where the matrix is singular.
  virtual bool improve() { return false; }
  /// A solution was good enough without.
  virtual void served() {}
  /// Gives up the analysis, which looks at numbers too.
  virtual void forget() = 0;

  /// What the next solution owes to earlier ones, on one rank; on several the analysis is made anew.
  virtual void save(Snapshot& snapshot) const = 0;
  virtual void load(const Snapshot& snapshot) = 0;
  /// Factors the matrix as it stands as the run did that load() has taken over from; false where it is singular.
  virtual bool restore() { return factor(); }

  /// What a user should know of how the matrix was solved, after it was; empty where there is nothing to say.
  virtual std::string remark() const { return {}; }
  virtual SolverWork work() const = 0;
  /// Memory of the factors as the package reports it; 0 when it does not.
  virtual double bytes() const = 0;
};

/// `package` as in the deck: MUMPS, KLU, UMFPACK, SUPERLU, CG; of a matrix on several ranks, MUMPS or CG.
std::unique_ptr<Factors> make_factors(Mat matrix, const std::string& package);

}  // namespace engrane::solve
