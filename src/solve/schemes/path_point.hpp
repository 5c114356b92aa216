// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

namespace engrane::solve {

/// An equilibrium at which the tangent is singular.
struct CriticalPoint {
  enum class Kind : unsigned char {
    limit,       ///< the loads have an extreme value along the path
    bifurcation  ///< another path of equilibria crosses
  };
  Kind kind = Kind::limit;
  double load_time = 0;
  int before = 0, after = 0;  ///< directions in which the equilibrium is unstable, before and behind it
  std::string mode;           ///< the motion that nothing resists, its largest components by name
  double switched = 0;        ///< the path goes on along the mode, from so large a displacement; 0: it does not
};

/// Where a scheme that follows a path has got to.
struct Course {
  double next = 0;                        ///< the step to be tried next
  bool arrived = false;                   ///< at the end of the path
  int unstable = 0;                       ///< directions in which the equilibrium is unstable
  double critical_time = 0;               ///< loads' time of the last critical point so far; 0: none yet
  std::optional<CriticalPoint> critical;  ///< the last step ended there
};

}  // namespace engrane::solve
