// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/snapshot.hpp"

namespace engrane::solve {

/// Decides how long the factors of a tangent serve (docs/theory.md, "Newton"; docs/decisions/0024-kept-factors.md).
///
/// With kept factors a solution converges linearly: each correction leaves a part θ of the residual. θ grows as the machine moves
/// away from where the factors belong. They are renewed when a solution with them would cost more than the average one since they
/// were made, renewal included: no other time makes that average less. Costs are counted, not timed, so that a run repeated, or
/// continued from a restart point, gives the same bits.
///
/// `residual` is over what it is to become: a solution has converged at 1.
class FactorPolicy {
 public:
  /// A solution begins with this residual. `renewal`: cost of a tangent and its factors, over that of a correction.
  void begin(double residual, double renewal);
  /// Whether the next correction is to be made with new factors.
  bool due() const;
  /// New factors have been made.
  void renewed();
  /// The factors kept are those of another matrix.
  void forget() { usable_ = false; }
  /// A correction has been made, and left this residual.
  void corrected(double residual);
  /// The solution has ended, well or not.
  void end(bool converged);

  bool usable() const { return usable_; }
  void save(Snapshot& snapshot) const;
  void load(const Snapshot& snapshot);

 private:
  /// Corrections with contraction `theta` from `residual` to 1.
  static double corrections(double residual, double theta);

  bool usable_ = false;
  double renewal_ = 0;
  double residual_ = 0;     ///< after the last correction
  double contraction_ = 0;  ///< weakest of this solution with the present factors; 0 where there is none yet
  int made_ = 0;            ///< corrections of this solution
  // since the factors were made
  double theta_ = 0;  ///< contraction of the last solution; 0 before there was one
  int age_ = 0;       ///< solutions
  double spent_ = 0;  ///< in corrections, their making included
};

}  // namespace engrane::solve
