// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "solve/schemes/collocation.hpp"

namespace engrane::solve {

/// Free vibrations that the steps of a run damp until little is left of them. A run with longer steps has lost them too, so that
/// the difference of the two does not show it.
///
/// The translations of a node, and its rotations, are looked at together. Third divided differences over the stages of a step
/// leave out what is slow: ẍ = −ω² x − 2 κ ẋ is fitted to those of the last steps. Where it fits, they are a vibration. Its
/// amplitude follows from the differences of x and ẋ, and what the scheme makes of it in a step from R(z) − exp(z) with
/// z = (iω − κ) h (Hairer and Wanner, Solving Ordinary Differential Equations II, 1996, IV.3, IV.5). Three amplitudes of the
/// acceleration are followed: what is left; what would be left if only κ damped it; and the sum of what steps have lost.
class LostVibrations {
 public:
  /// `slots`: number of motion slots of all nodes, six each.
  LostVibrations(const Collocation& collocation, std::size_t slots);

  /// Values at the stages of a step, by stage and slot.
  using Stages = std::span<const std::vector<double>>;
  /// Looks at a step that is tried: displacements from its beginning, velocities and accelerations, at the beginning and at the
  /// stages.
  void look(std::span<const double> v0, std::span<const double> a0, Stages y, Stages v, Stages a);
  /// The differences of accelerations of that step, by slot.
  std::span<const double> differences() const { return differences_[2]; }
  /// Takes that step, of length h. `first`: after the start or an event. `accelerations`: at its end. `inertia`: masses times
  /// differences(), or nothing.
  void take(double h, bool first, std::span<const double> accelerations, std::span<const double> inertia);

  /// Acceleration that is missing in this slot: root of its mean square over the time of all steps.
  double missing(std::size_t slot) const;
  /// The force (or moment) of inertia that is missing with these accelerations, as missing().
  double missing_force(std::size_t first_slot) const;
  /// Period of the vibration with this slot of which a step has lost most; 0 if there was none.
  double period(std::size_t slot) const;

 private:
  struct Amplitude {
    double left = 0;                ///< its square, mean of the last steps
    double whole = 0;               ///< without loss
    double lost = 0;                ///< sum of what steps have lost, at most `whole`
    double square = 0;              ///< of what is missing, integral over time
    double least = 0, largest = 0;  ///< accelerations at ends of steps
  };
  /// Sums of products of differences of displacements, velocities and accelerations.
  struct Fit {
    double xx = 0, xv = 0, vv = 0, ax = 0, av = 0, aa = 0;
  };
  struct Group {
    Fit fit;
    double rate = 0, decay = 0;            ///< ω and κ of the last good fit
    double accelerations = 0, forces = 0;  ///< sums of squares of what `inertia` is taken from, and of it
    double most_lost = 0, lost_rate = 0;   ///< largest loss of a step, and its ω
    std::array<Amplitude, 3> amplitudes;
  };
  /// What a step makes of exp(zt/h).
  struct Effect {
    double difference;     ///< third divided difference, by magnitude
    double factor, error;  ///< |R(z)|, |R(z) − exp(z)|
  };
  Effect effect(double omega_h, double kappa_h) const;
  /// Adds the differences of the step to the fit of a group; true if they are a vibration that matters: sets its rate and decay.
  bool fit(Group& group, std::size_t first, double h, bool fresh) const;

  const Collocation& collocation_;
  std::array<double, 4> weights_;  ///< of divided differences: the beginning and the stages
  std::array<std::vector<double>, 3> differences_;
  std::vector<Group> groups_;
  double time_ = 0;
};

}  // namespace engrane::solve
