// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "solve/algebra/factors.hpp"

namespace engrane::solve {

/// Packages used through PETSc's own interface: UMFPACK, SUPERLU and, with additions by Mumps, MUMPS.
class PackageFactors : public Factors {
 public:
  PackageFactors(Mat matrix, std::string package);

  bool factor() override;
  void solve(Vec right, Vec solution) override { check_petsc(MatSolve(factors_, right, solution)); }
  void solve_transposed(Vec right, Vec solution) override { check_petsc(MatSolveTranspose(factors_, right, solution)); }
  void forget() override;
  /// The values that the analysis was made for: they decide on the elimination order.
  void save(Snapshot& snapshot) const override;
  void load(const Snapshot& snapshot) override;
  SolverWork work() const override;
  double bytes() const override;

 protected:
  /// Stores the values that an analysis is made for.
  void note_analysed();
  bool failed() const;

  Mat matrix_;
  Owned<Mat> factors_;  ///< null before an analysis

 private:
  std::string package_;
  bool sequential_ = false;
  std::vector<double> analysed_for_;  ///< values that the analysis was made for, on one rank
};

}  // namespace engrane::solve
