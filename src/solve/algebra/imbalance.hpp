// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "assembly/assembler.hpp"
#include "solve/algebra/references.hpp"

namespace engrane::solve {

/// A correction this small (over the lengths around, or in radians) changes nothing that anybody can see: what residual is left
/// is the rounding of the sums themselves.
constexpr double negligible_correction = 1e-13;
/// And below this nothing moves at all, whatever the forces are compared with: a freely spinning body has forces that
/// cancel inside its one element, and leaves nothing but rounding to judge by.
constexpr double no_correction = 2e-15;

/// The largest residuals, each over what it is compared with (References); infinite where one is not a number.
struct Imbalance {
  double force = 0, moment = 0, length = 0, angle = 0;
  double constraint_force = 0;  ///< largest force kΦ of a constraint that is open by more than rounding, over the loads around
  int worst = -1;               ///< equation with the largest of all

  double largest() const { return std::max({force, moment, length, angle}); }
  /// Whether all have become this small.
  bool within(double precision) const { return largest() <= precision && constraint_force <= precision; }
  /// Takes the larger of both.
  void join(const Imbalance& other);
};

/// That of a residual of the assembler; the same on every rank.
Imbalance imbalance(const Assembler& assembler, const References& references, Vec residual);

}  // namespace engrane::solve
