// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "assembly/assembler.hpp"
#include "assembly/configuration.hpp"
#include "base/snapshot.hpp"
#include "model/solver_options.hpp"
#include "solve/constraints/motion.hpp"

namespace engrane::solve {

/// Local error of a step as estimated by schemes, relative to how fast things have moved so far: the position of a node may
/// depart from the true one at no more than TOL times the range of its velocity; rotations and scalars likewise. A vibration is
/// judged by its own amplitude, however fast the shaft below it turns, and units do not matter. So is the state of a controller:
/// states have no common unit, and none is small beside another.
///
/// Errors of equilibria do not add up: in statics, displacements take the place of velocities, and h is 1.
class StepError {
 public:
  StepError(const Assembler& assembler, const SolverOptions& options);

  bool wanted() const { return tolerance_ > 0; }
  /// Extends the ranges by the velocities (by motion slot) of an accepted configuration.
  void take(std::span<const double> velocities);
  /// Accuracy of positions, over a length or in radians: several times what the joints of a step leave open.
  static constexpr double known = 1e-12;
  /// Largest of `rates`, over its tolerance. `rates`: local error of displacements over the length h of the step, by motion
  /// slot. The velocities at the end of the step are included in the ranges. The rounding of positions does not count, nor what
  /// is `open` (over a length, or in radians).
  double over_tolerance(std::span<const double> rates, std::span<const double> velocities, double h, double open = known) const;
  /// Angle of the node that turns farthest in a step of h over the largest that results within the step can follow, or of
  /// FineForces over the largest at which their work can be integrated; to the power `order` with which errors grow. It may
  /// exceed 1 no more than other errors.
  double over_turn(std::span<const double> velocities, double h, int order) const;
  /// Violation, over a length or in radians, that joints may have at the end of a step of h so that what the next step closes
  /// is negligible beside its tolerance; at least `known`.
  double may_be_open(std::span<const double> velocities, double h) const;

  void save(Snapshot& snapshot) const;
  void load(const Snapshot& snapshot);

 private:
  /// What the equation of a controller's state says about its size, in the unit of its rate (statics: of its displacement).
  struct Signal {
    double lag = 0;       ///< time in which it follows what it measures; 0 in statics
    double level = 0;     ///< its size if what it measures moved by the extent of the model, or by a radian
    double by_speed = 0;  ///< the same for a speed of the extent or a radian per time, times time
    double begin = 0;     ///< its size at the start
    double noise(double h, double open) const;
  };
  static constexpr std::size_t measures = 4;
  /// Slots that are judged together: the translations of a node, its rotations, one scalar.
  struct Group {
    std::size_t first, size;
    std::size_t measure;         ///< the Measure of their equations
    double place;                ///< length, or angle, to which the rounding of positions is relative
    double least;                ///< least range of velocities to be used
    std::array<bool, 3> free{};  ///< those that have an equation
    std::optional<Signal> signal = {};
    /// Part of an error over the length of a step that is rounding, or due to what is `open`.
    double noise(double h, double open) const { return signal ? signal->noise(h, open) : open * place / h; }
  };
  Signal signal_of(const Assembler& assembler, const Configuration& c, const Unknown& u) const;
  double range(const Group& group, std::span<const double> velocities) const;
  /// Tolerance of each group: what the error of displacements over the length of a step may be.
  std::vector<double> allowed(std::span<const double> velocities) const;

  double tolerance_, longest_turn_;
  std::size_t nodes_;
  /// A scalar's motion slot, and the angle of FineForces over it.
  struct Repeating {
    std::size_t slot;
    double factor;
  };
  std::vector<Repeating> repeating_;
  bool statics_;
  std::vector<Group> groups_;
  std::vector<double> least_, largest_;
};

}  // namespace engrane::solve
