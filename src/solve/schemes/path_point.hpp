// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

namespace engrane::solve {

/// An equilibrium at which the tangent is singular.
struct CriticalPoint {
  enum class Kind : unsigned char {
    limit,       ///< the loads have an extremum along the path
    bifurcation  ///< another path of equilibria crosses
  };
  Kind kind = Kind::limit;
  double load_time = 0;
  int before = 0, after = 0;  ///< number of unstable directions before and behind it
  bool counted = true;        ///< false: the tangent was unsymmetric before it, and 1 stands for any odd number
  std::string mode;           ///< the motion that nothing resists: its largest components by name
  double switched = 0;        ///< displacement with which the path goes on along the mode; 0: it does not
};

/// Progress of a scheme that follows a path.
struct Course {
  double next = 0;                        ///< next step to be tried
  bool arrived = false;                   ///< at the end of the path
  int unstable = 0;                       ///< number of directions in which the equilibrium is unstable
  double critical_time = 0;               ///< load time of the last critical point so far; 0: none yet
  std::optional<CriticalPoint> critical;  ///< where the last step ended, if that is one
};

}  // namespace engrane::solve
