// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "assembly/assembler.hpp"
#include "solve/algebra/references.hpp"

namespace engrane::solve {

/// A correction this small (over the lengths around, or in radians) is at rounding level: what is left of the residual is the
/// rounding of the sums themselves.
constexpr double negligible_correction = 1e-13;
/// Below this nothing moves at all, whatever the reference of the forces: a freely spinning body has forces that cancel inside
/// its one element, so that only rounding is left to judge by.
constexpr double no_correction = 2e-15;

/// Largest residuals, each over its reference (References); infinite if one is not a number.
struct Imbalance {
  double force = 0, moment = 0, length = 0, angle = 0;
  double constraint_force = 0;  ///< largest force kΦ of a constraint that is open by more than rounding, over the loads around
  int worst = -1;               ///< equation with the largest of all

  double largest() const { return std::max({force, moment, length, angle}); }
  /// Whether all are at most this.
  bool within(double precision) const { return largest() <= precision && constraint_force <= precision; }
  /// Takes the larger of each.
  void join(const Imbalance& other);
};

/// Evaluates a residual of the assembler; the same on every rank.
Imbalance imbalance(const Assembler& assembler, const References& references, Vec residual);

/// Rounding of a position, over its size: a few units in its last place.
constexpr double last_places = 4 * std::numeric_limits<double>::epsilon();
/// Rounding of each unknown at `c`, by equation, from the length around it, or its position if that is larger. Times the
/// magnitudes of a tangent it makes the forces below which no residual can be reduced.
std::vector<double> rounding_of_unknowns(const Assembler& assembler, const References& references, const Configuration& c);

/// Whether no entry of a residual exceeds the `noise` of its equation, given for this rank's rows. Collective.
bool is_noise(Vec residual, const std::vector<double>& noise);

}  // namespace engrane::solve
