// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "model/model.hpp"
#include "solve/schemes/collocation.hpp"

namespace engrane::solve {

/// Free vibrations that the steps of a run damp until little is left of them. A run with longer steps has lost them too, so that
/// the difference of the two does not show it.
///
/// The translations of a node, and its rotations, are looked at together, and so is the motion of two nodes relative to each
/// other. Third divided differences over the stages of a step leave out what is slow: ẍ = −ω² x − 2 κ ẋ is fitted to those of the
/// last steps, at first as it is, then with the third derivative of a slow motion beside, which is the same in all of them. Where
/// it fits, they are a vibration. Its amplitude follows from the differences of x and ẋ, and what the scheme makes of it
/// in a step from R(z) − exp(z) with z = (iω − κ) h (Hairer and Wanner, Solving Ordinary Differential Equations II, 1996, IV.3,
/// IV.5). Three amplitudes of the acceleration are followed: what is left; what would be left if only κ damped it; and the sum of
/// what steps have lost. A vibration that has been found is followed further where a larger slow motion hides it from the fit.
class LostVibrations {
 public:
  /// Two nodes by their indices in Model::nodes, the smaller one first.
  using Pair = std::pair<int, int>;
  /// Pairs of nodes that an element of two nodes joins, none of them the ground, in ascending order.
  static std::vector<Pair> joined(const Model& model);

  /// `precision`: of iterations, over the loads. `extent`: of the model. `slots`: number of motion slots of all nodes, six each.
  /// `pairs`: whose relative motions are followed too, in ascending order.
  LostVibrations(const Collocation& collocation, double precision, double extent, std::size_t slots, std::vector<Pair> pairs);

  /// Values at the stages of a step, by stage and slot.
  using Stages = std::span<const std::vector<double>>;
  /// Looks at a step that is tried: displacements from its beginning, velocities and accelerations, at the beginning and at the
  /// stages.
  void look(std::span<const double> v0, std::span<const double> a0, Stages y, Stages v, Stages a);
  /// The differences of accelerations of that step, by slot.
  std::span<const double> differences() const { return {differences_[2].data(), slots_}; }
  /// Takes that step, of length h. `first`: after the start or an event. `velocities`, `accelerations`: at its end. `inertia`:
  /// masses times differences(), or nothing.
  void take(double h, bool first, std::span<const double> velocities, std::span<const double> accelerations,
            std::span<const double> inertia);

  /// First of the three slots of translations, followed by those of rotations, of the motion of two nodes relative to each other,
  /// in any order; of one node alone if the other is the ground (0). Slots of pairs lie behind those of the nodes.
  std::size_t relative(int a, int b) const;

  /// Acceleration that is missing in this slot: root of its mean square over the time of all steps.
  double missing(std::size_t slot) const;
  /// The force (or moment) of inertia that is missing with these accelerations, as missing().
  double missing_force(std::size_t first_slot) const;
  /// The same for velocities.
  double missing_speed(std::size_t slot) const;
  /// Range of the velocity at the ends of steps.
  double range_of_speed(std::size_t slot) const;
  /// Period of the vibration with this slot of which a step has lost most; 0 if there was none.
  double period(std::size_t slot) const;
  /// The periods by group of three slots.
  std::vector<double> periods() const;

 private:
  /// What a step makes of exp(zt/h).
  struct Effect {
    double difference;     ///< third divided difference, by magnitude
    double factor, error;  ///< |R(z)|, |R(z) − exp(z)|
  };
  struct Amplitude {
    double left = 0;                 ///< its square, mean of the last steps
    double whole = 0;                ///< without loss
    double lost = 0;                 ///< sum of what steps have lost, at most `whole`
    double expected = 0;             ///< what the last step has made of it
    double square = 0;               ///< of what is missing, integral over time
    double least = 0, largest = 0;   ///< accelerations at ends of steps
    double lowest = 0, highest = 0;  ///< velocities there

    /// Extends the ranges.
    void include(double velocity, double acceleration, bool first);
    /// Takes a step with this `amplitude` at its beginning; 0: it does not show.
    void step(double amplitude, double decayed, const Effect& effect, double h);
  };
  /// Sums of products of differences of displacements, velocities and accelerations.
  struct Products {
    double xx = 0, xv = 0, vv = 0, ax = 0, av = 0, aa = 0;
    /// Multiplies all of them, and adds the products of these, with a weight.
    void fade(double kept);
    void add(double x, double v, double a, double weight = 1);
  };
  struct Fit {
    Products products;
    std::array<std::array<double, 3>, 3> slow{};  ///< products with h³, by slot: of displacements, velocities and accelerations
    double slow_square = 0;                       ///< of h³ with itself
    int steps = 0, good = 0;                      ///< since the start or an event; good ones among them
  };
  struct Group {
    Fit fit;
    double rate = 0, decay = 0;            ///< ω of the last good fit, κ of all with that ω
    double certain = 0, decays = 0;        ///< sums for κ: of 1/σ² and of κ/σ², where σ is its standard error in a fit
    double accelerations = 0, forces = 0;  ///< sums of squares of what `inertia` is taken from, and of it
    double most_lost = 0, lost_rate = 0;   ///< largest loss of a step, and its ω
    std::array<Amplitude, 3> amplitudes;
  };
  Effect effect(double omega_h, double kappa_h) const;
  /// Adds the differences of the step to the fit of a group; true if they are a vibration that matters: sets its rate and decay.
  bool fit(Group& group, std::size_t first, double h, bool fresh) const;
  /// The same for these products of so many steps; `slow_beside`: what a slow motion adds has been taken out of them.
  static bool solve(const Products& products, int steps, double h, bool slow_beside, Group& group);
  /// Amplitude of the acceleration in a slot, from the differences of the step; 0 if it is none of the vibration followed there.
  double amplitude(const Group& group, std::size_t slot, const Effect& effect, bool found) const;
  /// Of the three slots, at ends of steps so far.
  double largest_acceleration(std::size_t group) const;
  /// Appends the relative values of all pairs to those of the nodes.
  void append_relative(std::vector<double>& values) const;

  const Collocation& collocation_;
  double noise_, extent_;
  std::size_t slots_;
  std::vector<Pair> pairs_;
  std::array<double, 4> weights_;                   ///< of divided differences: the beginning and the stages
  double sum_of_weights_ = 0;                       ///< of their magnitudes
  std::array<std::vector<double>, 3> differences_;  ///< of displacements, velocities and accelerations
  std::vector<char> rounding_;                      ///< of each slot of a node: its differences are rounding
  std::vector<Group> groups_;
  double time_ = 0;
};

}  // namespace engrane::solve
