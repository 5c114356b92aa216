// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "solve/constraints/motion.hpp"

namespace engrane::solve {

/// The motion within an accepted step, from what is known at its ends: polynomials of degree four for displacements, rotation
/// vectors from the beginning and scalars, with the values and rates of both ends and the second derivatives at the beginning.
class Interpolation {
 public:
  /// `from` and `to` are the ends, less than half a turn apart.
  Interpolation(const MotionSlots& motion, const Configuration& from, const Configuration& to);

  /// `c` becomes `from` moved to `time`, with its velocities; accelerations and multipliers are those of `from`.
  void at(double time, Configuration& c) const;

 private:
  const MotionSlots& motion_;
  const Configuration& from_;
  double begin_, step_;
  std::vector<double> first_, second_, third_, fourth_;  ///< coefficients of the powers of the part of the step; by motion slot
};

}  // namespace engrane::solve
