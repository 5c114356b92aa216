// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "solve/constraints/motion.hpp"

namespace engrane::solve {

/// Motion within an accepted step, from what is known at its ends: polynomials of degree five for displacements, rotation
/// vectors from the beginning and scalars, with the values, rates and second derivatives of both ends. For a step of h their
/// error is at most h⁶/46080 times the sixth derivative; that of their second derivatives is h⁴/1920 times it.
class Interpolation {
 public:
  /// `from` and `to`: the ends, less than half a turn apart; `scalars`: those of `to` before whole turns were removed.
  Interpolation(const MotionSlots& motion, const Configuration& from, const Configuration& to, std::span<const double> scalars);

  /// Displacements from the beginning by motion slot, their rates and second derivatives.
  struct Motion {
    std::vector<double> y, rates, second;
  };
  void at(double time, Motion& m) const;
  /// Sets `c` to the beginning moved by `m`, with its velocities and accelerations; multipliers are those of the beginning.
  void place(double time, const Motion& m, Configuration& c) const;

 private:
  const MotionSlots& motion_;
  const Configuration& from_;
  double begin_, step_;
  std::vector<double> first_, second_, third_, fourth_, fifth_;  ///< coefficients of the powers of t/h
};

}  // namespace engrane::solve
