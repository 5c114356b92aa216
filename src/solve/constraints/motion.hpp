// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "assembly/numbering.hpp"

namespace engrane::solve {

/// Flat access to a configuration by motion slot (six per node, then scalars), and the displacements the deck prescribes.
class MotionSlots {
 public:
  /// `adds_rotations`: rotation vectors add up (linear_rotation()), as in linear statics.
  MotionSlots(const Model& model, const Numbering& numbering, bool adds_rotations = false)
      : model_(model), numbering_(numbering), adds_rotations_(adds_rotations) {}
  bool adds_rotations() const { return adds_rotations_; }
  /// Gives the nodes of a configuration from another analysis the kind of rotations that this one has.
  void take_over(Configuration& c) const;

  std::size_t size() const { return static_cast<std::size_t>(numbering_.motion_slots()); }

  /// `to` = `from` moved by y: positions and scalars are added, rotations multiplied by exp of the rotation vector, or their
  /// vectors added; sets NodeState::T. Rates of nodes are copied; those of scalars, the history and the rest of `to` are left
  /// alone. Sums are compensated (Configuration::remainders).
  void move(const Configuration& from, std::span<const double> y, Configuration& to) const;

  /// Starting point of move(); a fifth of a configuration's size if few nodes have turned.
  class Origin {
   public:
    explicit Origin(const Configuration& c);

   private:
    friend class MotionSlots;
    std::vector<Vec3> places;                          ///< of all nodes
    std::vector<std::pair<std::size_t, Mat3>> turned;  ///< nodes turned from the reference configuration, ascending
    std::vector<double> scalars;
    std::vector<double> remainders;  ///< empty: all are zero
  };
  /// Moves `to`, which was equal to the origin and has only been moved since.
  void move(const Origin& from, std::span<const double> y, Configuration& to) const;

  std::vector<double> velocities(const Configuration& c) const;
  std::vector<double> accelerations(const Configuration& c) const;
  void set_velocities(std::span<const double> v, Configuration& c) const;
  void set_accelerations(std::span<const double> a, Configuration& c) const;

  /// Copies the entries of `unknowns` (one per equation) into the motion slots that have an equation.
  void scatter(std::span<const double> unknowns, std::span<double> motion) const;

  /// The reverse: sets the entry of `unknowns` for each motion slot that has an equation.
  void gather(std::span<const double> motion, std::span<double> unknowns) const;

  /// A prescribed slot at a given time: displacement from the reference, its rate and acceleration.
  struct Prescribed {
    std::size_t slot;
    double u, v, a;
  };
  std::vector<Prescribed> prescribed(double time) const;
  /// Writes the displacements of these slots from one time to another into the increment `y`, or their rates and accelerations
  /// into those of all slots.
  void prescribe_increment(double from, double to, std::span<double> y) const;
  void prescribe_rates(double time, std::span<double> v) const;
  void prescribe_accelerations(double time, std::span<double> a) const;

 private:
  const Model& model_;
  const Numbering& numbering_;
  bool adds_rotations_;
};

}  // namespace engrane::solve
