// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <vector>

#include "assembly/configuration.hpp"
#include "base/snapshot.hpp"
#include "model/solver_options.hpp"
#include "solve/constraints/motion.hpp"

namespace engrane::solve {

/// Local error of a step as estimated by schemes, relative to how fast things have moved so far: the position of a node may
/// depart from the true one at no more than TOL times the range of its velocity; rotations and scalars likewise. A vibration is
/// judged by its own amplitude, however fast the shaft below it turns, and units do not matter.
///
/// Errors of equilibria do not add up: in statics, displacements take the place of velocities, and h is 1.
class StepError {
 public:
  StepError(const Model& model, const Numbering& numbering, const SolverOptions& options);

  bool wanted() const { return tolerance_ > 0; }
  /// Extends the ranges by the velocities (by motion slot) of an accepted configuration.
  void take(std::span<const double> velocities);
  /// Accuracy of positions, over a length or in radians: several times what the joints of a step leave open.
  static constexpr double known = 1e-12;
  /// Largest of `rates`, over its tolerance. `rates`: local error of displacements over the length h of the step, by motion
  /// slot. The velocities at the end of the step are included in the ranges. The rounding of positions does not count, nor what
  /// is `open` (over a length, or in radians).
  double over_tolerance(std::span<const double> rates, std::span<const double> velocities, double h, double open = known) const;
  /// Violation, over a length or in radians, that joints may have at the end of a step of h so that what the next step closes
  /// is negligible beside its tolerance; at least `known`.
  double may_be_open(std::span<const double> velocities, double h) const;

  void save(Snapshot& snapshot) const;
  void load(const Snapshot& snapshot);

 private:
  /// The kinds of Measure, and signals of controllers, whatever their unit.
  static constexpr std::size_t signals = 4, kinds = 5;
  /// Slots that are judged together: the translations of a node, its rotations, one scalar.
  struct Group {
    std::size_t first, size, kind;  ///< `kind`: the Measure of their equations, or `signals`
    double place;                   ///< length, or angle, to which the rounding of positions is relative
    double least;                   ///< least range of velocities to be used
    std::array<bool, 3> free{};     ///< those that have an equation
  };
  double range(const Group& group, std::span<const double> velocities) const;
  /// Tolerance of each group: what the error of displacements over the length of a step may be.
  std::vector<double> allowed(std::span<const double> velocities) const;

  double tolerance_;
  std::vector<Group> groups_;
  std::vector<double> least_, largest_;
};

}  // namespace engrane::solve
