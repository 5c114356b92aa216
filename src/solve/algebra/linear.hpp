// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "solve/algebra/klu.hpp"

namespace engrane::solve {

/// A direct solver on one matrix whose pattern never changes: the symbolic analysis is done once.
class LinearSolver {
 public:
  /// `package` as in the deck: MUMPS, KLU, UMFPACK, SUPERLU. On several ranks only MUMPS works and is taken.
  LinearSolver(Mat matrix, const std::string& package);

  KSP ksp() const { return ksp_; }
  const std::string& package() const { return package_; }

  /// Factors the matrix as it stands and solves; false when it is singular to working precision.
  bool solve(Vec right, Vec solution);

  /// After a failure: gives MUMPS more room when that was all it lacked; true when it is worth another try.
  bool enlarge();
  /// Forgets the analysis, which looks at numbers too: after a failure, or before matrices of another kind.
  void reset();

  /// What the next solution owes to earlier ones: KLU's pivots. The other packages choose theirs for each matrix.
  void save(Snapshot& snapshot) const {
    if (klu_) klu_->save(snapshot);
  }
  void load(const Snapshot& snapshot) {
    if (klu_ && snapshot.has("klu/chosen_for")) klu_->load(snapshot);
  }

  /// Memory of the factors in bytes, as the package reports it; 0 when it does not.
  double factor_bytes() const;

 private:
  Mat factor() const;
  void set_up();
  std::unique_ptr<Klu> klu_;  ///< before ksp_, which uses it
  Owned<KSP> ksp_;
  std::string package_;
  int mumps_room_ = 50;  ///< ICNTL(14): per cent over the estimate
};

}  // namespace engrane::solve
