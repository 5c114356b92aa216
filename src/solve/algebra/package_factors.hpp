// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "solve/algebra/factors.hpp"

namespace engrane::solve {

/// The packages that PETSc's own interface serves well: MUMPS, on any number of ranks, UMFPACK and SUPERLU.
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

 private:
  bool mumps() const { return package_ == "MUMPS"; }
  bool analyse();
  /// Whether the last factorisation by MUMPS lacked nothing but room: it has more now.
  bool enlarge();
  bool failed() const;

  Mat matrix_;
  std::string package_;
  bool sequential_ = false;
  Owned<Mat> factors_;                ///< null before an analysis
  std::vector<double> analysed_for_;  ///< values of that matrix, on one rank
  int room_ = 50;                     ///< MUMPS' ICNTL(14): per cent over the estimate
};

}  // namespace engrane::solve
