// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <klu.h>

#include <vector>

#include "solve/algebra/factors.hpp"

namespace engrane::solve {

/// KLU. The pivots of one factorisation are reused for the next ones, which makes these two to four times faster than with a
/// search for pivots. Where old pivots fail, as in a machine whose matrix changes much from step to step, they are not tried
/// for a while. Davis and Palamadai Natarajan, ACM Trans. Math. Softw. 37 (2010) 36.
class Klu : public Factors {
 public:
  /// `matrix`: sequential.
  explicit Klu(Mat matrix);
  ~Klu() override { free(); }

  bool factor() override;
  void solve(Vec right, Vec solution) override;
  void solve_transposed(Vec right, Vec solution) override;
  /// With new pivots.
  bool improvable() const override { return stale_; }
  bool improve() override;
  void served() override;
  void forget() override;
  /// The pivots, as the matrix that they were chosen for, and for how long old ones are not tried.
  void save(Snapshot& snapshot) const override;
  void load(const Snapshot& snapshot) override;
  bool restore() override;
  SolverWork work() const override;
  double bytes() const override { return common_.memusage > 0 ? static_cast<double>(common_.memusage) : 0; }

 private:
  void free();
  /// Factors with the present pivots; false if they are of no use.
  bool refactor();
  bool factor_with_new_pivots();
  /// Factors the values in chosen_for_ with new pivots.
  bool factor_chosen();

  Mat matrix_;
  klu_common common_{};
  klu_symbolic* symbolic_ = nullptr;
  klu_numeric* numeric_ = nullptr;
  std::vector<double> chosen_for_;  ///< values of the matrix that the pivots were chosen for
  bool stale_ = false;              ///< pivots are those of an earlier matrix
  int trials_lost_ = 0;             ///< consecutive failures of old pivots
  int wait_ = 0;                    ///< number of matrices for which old pivots are not tried
};

}  // namespace engrane::solve
