// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/snapshot.hpp"

namespace engrane::solve {

/// Decides how long the factors of a tangent are kept (docs/theory.md, "Newton"; docs/decisions/0024-kept-factors.md).
///
/// With kept factors Newton's iteration converges linearly: each correction leaves a fraction θ of the residual. θ grows as the
/// machine moves away from where the factors were made. They are renewed when a solution with them would cost more than the
/// average solution since they were made, renewal included; this time gives the lowest average. Costs are counted, not timed,
/// so that a run repeated, or continued from a restart point, gives the same bits.
///
/// Residuals are relative to their target: a solution has converged at 1.
class FactorPolicy {
 public:
  /// Begins a solution with this residual. `renewal`: cost of a tangent and its factors, relative to that of a correction.
  void begin(double residual, double renewal);
  /// Whether the next correction needs new factors.
  bool due() const;
  /// New factors have been made.
  void renewed();
  /// The kept factors belong to another matrix.
  void forget() { usable_ = false; }
  /// A correction has been made and has left this residual.
  void corrected(double residual);
  /// The solution has ended, converged or not.
  void end(bool converged);

  bool usable() const { return usable_; }
  void save(Snapshot& snapshot) const;
  void load(const Snapshot& snapshot);

 private:
  /// Number of corrections with contraction `theta` from `residual` to 1; infinite if the contraction is too weak.
  static double corrections(double residual, double theta);

  bool usable_ = false;
  double renewal_ = 0;
  double residual_ = 0;     ///< after the last correction
  double contraction_ = 0;  ///< weakest of this solution with the present factors; 0: none yet
  int made_ = 0;            ///< corrections of this solution
  // since the factors were made
  double theta_ = 0;  ///< contraction of the last solution; 0 before there was one
  int age_ = 0;       ///< number of solutions
  double spent_ = 0;  ///< cost in corrections, that of making the factors included
};

}  // namespace engrane::solve
