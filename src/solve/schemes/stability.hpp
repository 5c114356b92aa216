// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "solve/schemes/solver_context.hpp"

namespace engrane::solve {

/// Watches equilibria of a static analysis for ones that are unstable, as Newton's iteration finds those of a straight column
/// beyond its buckling load: nature leaves them. A few are examined, evenly spread over the time of the analysis, and the last.
class StabilityWatch {
 public:
  explicit StabilityWatch(SolverContext& context);

  /// Examines the equilibrium if that is due. Collective.
  void take(const Configuration& equilibrium, bool last);
  /// A warning of the first that was unstable; empty if none was.
  std::string remark() const;

 private:
  SolverContext& context_;
  bool active_;
  double due_;                         ///< time of the next to be examined
  std::optional<double> unstable_at_;  ///< time of the first unstable one
  int directions_ = 0;                 ///< in which it is unstable
};

}  // namespace engrane::solve
