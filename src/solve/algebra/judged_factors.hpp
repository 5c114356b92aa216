// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "solve/algebra/backward_error.hpp"
#include "solve/algebra/factors.hpp"

namespace engrane::solve {

/// Factors of one matrix, with a check of the solutions.
///
/// The first solution with each factorisation is checked by its backward error (BackwardError), refined if that helps, and
/// repeated with better factors if it does not. Later ones are checked too, unless one before was as good as it can be and
/// was not zero.
class JudgedFactors {
 public:
  /// `package`: as for make_factors(); `kinds`: kind of each row (BackwardError).
  JudgedFactors(Mat matrix, const std::string& package, const std::vector<unsigned char>& kinds);

  Factors& package() { return *factors_; }
  const Factors& package() const { return *factors_; }

  /// Factors the matrix as it stands; false if it is singular. Throws MemoryShortage.
  bool factor();
  /// Solves with the present factors, made if there are none; false if the matrix is singular to working precision.
  bool solve(Vec right, Vec solution);

  /// See LinearSolver::correct_only().
  void correct_only(bool corrections);
  /// Discards the analysis.
  void reset();
  /// Factors the matrix as it stands in the same way as an earlier run; `proven`: proven() of that run. False if it is
  /// singular.
  bool restore(bool proven);

  /// Whether a solution with these factors was good enough at once.
  bool proven() const { return proven_; }
  /// Backward error of the last solution that was checked.
  double backward_error() const { return error_; }
  /// See LinearSolver::condition().
  std::optional<double> condition();

 private:
  void solve_well(Vec right, Vec solution);
  /// Solves, refines once if the backward error requires it, and stores the backward error.
  void solve_and_refine(Vec right, Vec solution);

  Mat matrix_;
  std::unique_ptr<Factors> factors_;
  BackwardError backward_error_;
  Owned<Vec> correction_;
  enum class State { forgotten, ready, singular } state_ = State::forgotten;  ///< of the factors
  bool proven_ = false;
  double enough_ = good_solution;  ///< backward error of a solution that is good enough
  double error_ = 0;
};

}  // namespace engrane::solve
