// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "solve/algebra/package_factors.hpp"
#include "solve/algebra/symmetry.hpp"

namespace engrane::solve {

/// MUMPS, on any number of ranks. A matrix that is symmetric is factored as such, in half the time and memory: LDLᵀ with pivots
/// from the diagonal where none of it is zero or negative, with pivots of one and two rows where it is (constraints), LU where
/// the matrix is not symmetric. The first of these that fits is taken; where its solutions are not good enough the next one.
class Mumps final : public PackageFactors {
 public:
  explicit Mumps(Mat matrix) : PackageFactors(matrix, "MUMPS"), symmetry_(matrix), half_(is_half(matrix)) {}

  bool factor() override;
  /// With more pivots to choose from.
  bool improvable() const override { return form_ != Form::general && !(half_ && form_ == Form::symmetric); }
  bool improve() override;
  void forget() override;
  void save(Snapshot& snapshot) const override;
  void load(const Snapshot& snapshot) override;
  std::optional<ForeseenFactors> foresee() override;
  SolverWork work() const override;
  double bytes() const override;

 private:
  enum class Form : unsigned char { unknown, definite, symmetric, general };

  /// The order of elimination and what it will take; false where MUMPS finds the matrix singular by its pattern.
  bool analyse();
  bool factor_as_analysed();
  /// Goes on with another form; the analysis belongs to the one before.
  void become(Form form);
  /// Whether the last factorisation lacked nothing but room: the next one, with an analysis of its own, has more.
  bool enlarge();
  ForeseenFactors foreseen() const;
  void refuse_without_memory() const;

  SymmetryTest symmetry_;
  bool half_;  ///< the matrix cannot be factored but as a symmetric one
  Form form_ = Form::unknown;
  int room_ = 50;  ///< MUMPS' ICNTL(14): per cent over the estimate
};

}  // namespace engrane::solve
