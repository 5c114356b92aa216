// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "solve/algebra/backward_error.hpp"
#include "solve/algebra/factors.hpp"

namespace engrane::solve {

/// The factors of one matrix, and solutions with them that are judged.
///
/// The first solution with each factorisation is judged by its backward error (BackwardError), refined where that helps and found
/// with better factors where it does not; the others too, unless the first was as good as it can be.
class JudgedFactors {
 public:
  /// `package` as make_factors() knows it; `kinds`: what each row is (BackwardError).
  JudgedFactors(Mat matrix, const std::string& package, const std::vector<unsigned char>& kinds);

  Factors& package() { return *factors_; }
  const Factors& package() const { return *factors_; }

  /// Of the matrix as it stands; false where it is singular. Throws MemoryShortage.
  bool factor();
  /// With the factors as they are, made where there are none; false where the matrix is singular to working precision.
  bool solve(Vec right, Vec solution);

  /// LinearSolver::correct_only()
  void correct_only(bool corrections);
  /// Forgets the analysis.
  void reset();
  /// Factors the matrix as it stands as a run did that knew whether solutions with its factors were `proven`; false where it is
  /// singular.
  bool restore(bool proven);

  /// Whether a solution with these factors was good enough at once.
  bool proven() const { return proven_; }
  /// Backward error of the last solution that was looked at.
  double backward_error() const { return error_; }
  /// LinearSolver::condition()
  std::optional<double> condition();

 private:
  void solve_well(Vec right, Vec solution);
  /// Solves, refines once where the backward error asks for it, and notes the backward error.
  void solve_and_refine(Vec right, Vec solution);

  Mat matrix_;
  std::unique_ptr<Factors> factors_;
  BackwardError backward_error_;
  Owned<Vec> correction_;
  enum class State { forgotten, ready, singular } state_ = State::forgotten;  ///< the factors are
  bool proven_ = false;
  double enough_ = good_solution;  ///< backward error of a solution that is good enough
  double error_ = 0;
};

}  // namespace engrane::solve
