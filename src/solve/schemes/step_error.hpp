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

/// The local error of a step as schemes estimate it, compared with how fast things have moved so far: the position of a node
/// departs from the truth at no more than TOL times the range of its velocity, its rotation and scalars alike. A vibration is
/// judged by its own amplitude, however fast the shaft below it turns, and no unit counts.
///
/// Errors of equilibria do not add up: of statics, displacements stand in the place of velocities, and h is 1.
class StepError {
 public:
  StepError(const Model& model, const Numbering& numbering, const SolverOptions& options);

  bool wanted() const { return tolerance_ > 0; }
  /// Takes the velocities (by motion slot) of an accepted configuration.
  void take(std::span<const double> velocities);
  /// Part of a length, or of a radian, that positions are known to: what the joints of a step leave open, several times over.
  static constexpr double known = 1e-12;
  /// The largest of `rates`, the local error of displacements over the length h of the step by motion slot, over its tolerance.
  /// The velocities at the end of the step count as reached. What rounding makes of positions does not count, nor what part of a
  /// length, or of a radian, they are `open` by.
  double over_tolerance(std::span<const double> rates, std::span<const double> velocities, double h, double open = known) const;
  /// The part of a length, or of a radian, that joints may be left open by at the end of a step of h, so that what the next step
  /// closes does not count beside its tolerance; no less than `known`.
  double may_be_open(std::span<const double> velocities, double h) const;

  void save(Snapshot& snapshot) const;
  void load(const Snapshot& snapshot);

 private:
  static constexpr std::size_t measures = 4;
  /// Slots that are judged together: the translations of a node, its rotations, one scalar.
  struct Group {
    std::size_t first, size, kind;  ///< `kind`: the Measure of their equations
    double place;                   ///< the length, or angle, whose rounding positions have
    double least;                   ///< a range of velocities that is smaller counts as this
    std::array<bool, 3> free{};     ///< those that have an equation
  };
  double range(const Group& group, std::span<const double> velocities) const;
  /// What the error of displacements over the length of a step may be, of each group.
  std::vector<double> allowed(std::span<const double> velocities) const;

  double tolerance_;
  std::vector<Group> groups_;
  std::vector<double> least_, largest_;
};

}  // namespace engrane::solve
