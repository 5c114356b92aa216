// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "solve/algebra/klu.hpp"

namespace engrane::solve {

/// A direct solver on one matrix whose pattern never changes: the symbolic analysis is done once.
class LinearSolver {
 public:
  /// `package` as in the deck: AUTO, MUMPS, KLU, UMFPACK, SUPERLU. On several ranks only MUMPS works and is taken.
  LinearSolver(Mat matrix, const std::string& package);

  KSP ksp() const { return ksp_; }
  const std::string& package() const { return package_; }

  /// Factors the matrix as it stands and solves; false when it is singular to working precision.
  bool solve(Vec right, Vec solution);

  /// What each row is (Klu::tell_kinds).
  void tell_kinds(std::vector<unsigned char> kinds) {
    if (klu_) klu_->tell_kinds(std::move(kinds));
  }
  /// Whether the next solutions are corrections with kept factors (Klu::correct_only).
  void correct_only(bool corrections) {
    if (klu_) klu_->correct_only(corrections);
  }

  /// After a failure: gives MUMPS more room when that was all it lacked; true when it is worth another try.
  bool enlarge();
  /// Forgets the analysis, which looks at numbers too: after a failure, or before matrices of another kind.
  void reset();

  /// To be told of every matrix before it is factored: the first after an analysis was forgotten decides on the order of
  /// elimination, which looks at numbers too, and is kept for save().
  void note_matrix();
  /// What the next solution owes to earlier ones: the matrix that the analysis was made for, and KLU's pivots. Only on one rank;
  /// on several the analysis is made anew.
  void save(Snapshot& snapshot) const;
  void load(const Snapshot& snapshot);
  /// The matrix whose factors go on to serve, as it stands; on one rank.
  void save_factors(Snapshot& snapshot) const;
  /// Factors the matrix as it stands as the run did that load() has taken over from.
  void restore_factors();
  /// Takes it back, after load(), and factors it; false where there is none.
  bool load_factors(const Snapshot& snapshot);

  /// What a factorisation and a solution cost, in instructions: counted, so the same in every run.
  struct Work {
    double factor = 0, solution = 0;
  };
  Work work() const;

  /// Memory of the factors in bytes, as the package reports it; 0 when it does not.
  double factor_bytes() const;

 private:
  Mat factor() const;
  Mat matrix() const;
  std::vector<double> values() const;
  /// Writes the values of a matrix like this one; false where there are not as many as it has.
  bool set_values(const std::vector<double>& values);
  void set_up();
  std::unique_ptr<Klu> klu_;  ///< before ksp_, which uses it
  Owned<KSP> ksp_;
  std::string package_;
  bool sequential_ = false;
  std::vector<double> analysed_for_;  ///< values of that matrix; empty: none has been analysed
  int mumps_room_ = 50;               ///< ICNTL(14): per cent over the estimate
};

}  // namespace engrane::solve
