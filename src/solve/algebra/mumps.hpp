// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "solve/algebra/package_factors.hpp"
#include "solve/algebra/symmetry.hpp"

namespace engrane::solve {

/// MUMPS, on any number of ranks. A symmetric matrix is factored as such, in half the time and memory: LDLᵀ with diagonal
/// pivots if the whole diagonal is positive, with pivots of one and two rows if it is not (constraints). Other matrices are
/// factored by LU. The first of these forms that fits is used; if its solutions are not good enough, the next one.
class Mumps final : public PackageFactors {
 public:
  /// With `low_rank`, blocks of the factors are approximated by matrices of low rank (BLR) for as long as the solutions are good
  /// enough.
  explicit Mumps(Mat matrix, bool low_rank = false)
      : PackageFactors(matrix, "MUMPS"), symmetry_(matrix), half_(is_half(matrix)), low_rank_(low_rank) {}

  bool factor() override;
  /// In full rank, then with more pivots to choose from.
  bool improvable() const override { return low_rank_ || more_pivots(); }
  bool improve() override;
  void forget() override;
  void save(Snapshot& snapshot) const override;
  void load(const Snapshot& snapshot) override;
  std::optional<ForeseenFactors> foresee() override;
  std::string remark() const override;
  SolverWork work() const override;
  double bytes() const override;

 private:
  enum class Form : unsigned char { unknown, definite, symmetric, general };

  /// Finds the elimination order and predicts the cost; false if MUMPS finds the matrix singular by its pattern.
  bool analyse();
  bool factor_as_analysed();
  bool more_pivots() const { return form_ != Form::general && !(half_ && form_ == Form::symmetric); }
  /// Switches to another form, and discards the analysis, which belongs to the old one.
  void become(Form form);
  /// Whether the last factorisation failed only for lack of room. The next one, with an analysis of its own, then has more.
  bool enlarge();
  ForeseenFactors foreseen() const;
  void refuse_without_memory() const;

  SymmetryTest symmetry_;
  bool half_;  ///< only half of the matrix is stored: it can be factored as a symmetric one only
  bool low_rank_;
  bool left_low_rank_ = false;  ///< a solution with low-rank blocks was not good enough
  Form form_ = Form::unknown;
  int room_ = 50;  ///< MUMPS' ICNTL(14): workspace above the estimate, per cent
};

}  // namespace engrane::solve
