// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <klu.h>

#include <string>
#include <vector>

#include "assembly/petsc.hpp"

namespace engrane::solve {

/// KLU on one sequential matrix whose pattern never changes, as a preconditioner of PETSc (PCSHELL). The pivots of one
/// factorisation serve the next ones too, which makes these two to four times faster than a factorisation that looks for its own;
/// every solution is judged by its backward error, component by component (Oettli and Prager), refined where that helps
/// and found with new pivots where it does not. Davis and Palamadai Natarajan, ACM Trans. Math. Softw. 37 (2010) 36.
class Klu {
 public:
  explicit Klu(Mat matrix);
  ~Klu() { forget(); }
  Klu(const Klu&) = delete;
  Klu& operator=(const Klu&) = delete;

  /// Makes `pc` this solver; `this` must outlive it.
  void serve(PC pc);
  /// Gives up pattern analysis and pivots.
  void forget();
  /// Memory of the factors.
  double bytes() const { return common_.memusage > 0 ? static_cast<double>(common_.memusage) : 0; }

 private:
  static PetscErrorCode set_up(PC pc);
  static PetscErrorCode apply(PC pc, Vec right, Vec solution);
  bool factor(bool fresh);
  /// Solves, refines once where the backward error asks for it, and returns the backward error.
  double solve(const double* right, double* solution);
  /// The remainder right − A solution goes to residual_; returns its size, each row over that of its terms.
  double backward_error(const double* right, const double* solution);

  Mat matrix_;
  int size_ = 0;
  const PetscInt *begin_ = nullptr, *column_ = nullptr;  ///< rows of the matrix: to KLU, columns of its transpose
  klu_common common_{};
  klu_symbolic* symbolic_ = nullptr;
  klu_numeric* numeric_ = nullptr;
  bool stale_ = false;  ///< pivots are those of an earlier matrix
  PetscLogEvent factoring_ = -1, solving_ = -1;
  std::vector<double> residual_;
};

}  // namespace engrane::solve
