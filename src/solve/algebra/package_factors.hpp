// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "solve/algebra/factors.hpp"

namespace engrane::solve {

/// What PETSc's own interface to a package serves well: UMFPACK, SUPERLU and, with what Mumps adds, MUMPS.
class PackageFactors : public Factors {
 public:
  PackageFactors(Mat matrix, std::string package);

  bool factor() override;
  void solve(Vec right, Vec solution) override { check_petsc(MatSolve(factors_, right, solution)); }
  void solve_transposed(Vec right, Vec solution) override { check_petsc(MatSolveTranspose(factors_, right, solution)); }
  void forget() override;
  /// The matrix that the analysis was made for: it decides on the order of elimination.
  void save(Snapshot& snapshot) const override;
  void load(const Snapshot& snapshot) override;
  SolverWork work() const override;
  double bytes() const override;

 protected:
  /// Takes over the values that an analysis is made for from a matrix of the same pattern.
  void note_analysed();
  bool failed() const;

  Mat matrix_;
  Owned<Mat> factors_;  ///< null before an analysis

 private:
  std::string package_;
  bool sequential_ = false;
  std::vector<double> analysed_for_;  ///< values of that matrix, on one rank
};

}  // namespace engrane::solve
