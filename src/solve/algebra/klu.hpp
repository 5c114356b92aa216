// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <klu.h>

#include <string>
#include <utility>
#include <vector>

#include "assembly/petsc.hpp"
#include "base/snapshot.hpp"

namespace engrane::solve {

/// KLU on one sequential matrix whose pattern never changes, as a preconditioner of PETSc (PCSHELL). The pivots of one
/// factorisation serve the next ones too, which makes these two to four times faster than a factorisation that looks for its own;
/// the first solution with each factorisation is judged by its backward error, component by component (Oettli and Prager),
/// refined where that helps and found with new pivots where it does not; the others too, unless the first was as good as it can
/// be. Where old pivots do not serve, as in a machine whose matrix changes much from step to step, they are not tried for a
/// while. Davis and Palamadai Natarajan, ACM Trans. Math. Softw. 37 (2010) 36.
class Klu {
 public:
  explicit Klu(Mat matrix);
  ~Klu() { forget(); }
  Klu(const Klu&) = delete;
  Klu& operator=(const Klu&) = delete;

  /// Makes `pc` this solver; `this` must outlive it.
  void serve(PC pc);
  /// What each row is: rows of one kind have one unit, so that their terms can be compared (fewer than 8 kinds).
  void tell_kinds(std::vector<unsigned char> kinds) { kinds_ = std::move(kinds); }
  /// Whether solutions are corrections with factors of another tangent. Those need not be as good as rounding allows: what an
  /// iteration leaves of a residual is then the difference of the tangents. No refinement, no look at those after a first good
  /// one.
  void correct_only(bool corrections);
  /// Gives up pattern analysis and pivots.
  void forget();
  /// The pivots, by the matrix that they were chosen for, and for how long old ones are not tried.
  void save(Snapshot& snapshot) const;
  void load(const Snapshot& snapshot);
  /// Factors the matrix as it stands as a run did that load() has taken the pivots of; the next set-up of the preconditioner
  /// keeps these factors.
  void restore_factors();
  /// Nonzeros of the factors; 0 before there are any.
  double entries() const { return numeric_ ? static_cast<double>(numeric_->lnz) + numeric_->unz : 0; }
  /// Floating-point operations of a factorisation, estimated.
  double operations() const { return symbolic_ ? symbolic_->est_flops : 0; }
  /// Memory of the factors.
  double bytes() const { return common_.memusage > 0 ? static_cast<double>(common_.memusage) : 0; }

 private:
  static PetscErrorCode set_up(PC pc);
  static PetscErrorCode apply(PC pc, Vec right, Vec solution);
  void find_pattern();
  /// With the pivots there are, where there are any.
  bool refactor();
  /// With pivots of its own.
  bool factor();
  /// The same for the values in chosen_for_.
  bool factor_chosen();
  bool refactor_now();
  /// Solves, refines once where the backward error asks for it, and returns the backward error.
  double solve(const double* right, double* solution);
  /// The remainder right − A solution goes to residual_; returns its size, each row over that of its terms. Rows that the
  /// rounding of others fills, as those of motions that lead out of the plane of a mechanism, count by the terms of the largest
  /// row of their kind (after Arioli, Demmel and Duff, SIAM J. Matrix Anal. Appl. 10 (1989) 165, section 2).
  double backward_error(const double* right, const double* solution);

  Mat matrix_;
  int size_ = 0;
  const PetscInt *begin_ = nullptr, *column_ = nullptr;  ///< rows of the matrix: to KLU, columns of its transpose
  klu_common common_{};
  klu_symbolic* symbolic_ = nullptr;
  klu_numeric* numeric_ = nullptr;
  std::vector<double> chosen_for_;  ///< values of the matrix that the pivots were chosen for
  bool stale_ = false;              ///< pivots are those of an earlier matrix
  bool proven_ = false;             ///< a solution with these factors was good enough at once
  double enough_;                   ///< backward error of such a solution
  bool restored_ = false;           ///< the factors are those of restore_factors()
  bool proven_before_ = false;      ///< proven_ of the run that load() has taken the pivots of
  int trials_lost_ = 0;             ///< old pivots in a row that did not serve
  int wait_ = 0;                    ///< matrices for which old pivots are not tried
  PetscLogEvent factoring_ = -1, solving_ = -1;
  std::vector<double> residual_, terms_;
  std::vector<unsigned char> kinds_;  ///< of rows; empty: not told
};

}  // namespace engrane::solve
