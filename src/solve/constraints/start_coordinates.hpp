// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "assembly/assembler.hpp"

namespace engrane::solve {

/// The coordinates of joints whose values or speeds the deck gives for the start, as further constraints of that one moment.
/// Nothing is assembled for them: they are read from the channels of their elements, and their gradients from the channels of
/// their rates, which are linear in velocities.
class StartCoordinates {
 public:
  explicit StartCoordinates(const Assembler& assembler) : assembler_(assembler) {}

  /// A coordinate (or its rate) with what it is to be.
  struct Wanted {
    const InitialCoordinate* coordinate;
    double value;
  };
  /// Those of the deck that are positions, or velocities.
  std::vector<Wanted> wanted(bool velocity) const;

  double value(const Configuration& c, const InitialCoordinate& coordinate) const { return channel(c, coordinate, 0); }
  double rate(const Configuration& c, const InitialCoordinate& coordinate) const { return channel(c, coordinate, 1); }
  /// By how much the wanted ones are missed, in their own units.
  std::vector<double> missed(const Configuration& c, const std::vector<Wanted>& all) const;
  /// What a miss is measured by: the extent, or a radian, and the value itself.
  double size(const Wanted& one) const;
  /// Derivative of the coordinate by every equation's unknown; 0 for multipliers.
  std::vector<double> gradient(const Configuration& c, const InitialCoordinate& coordinate) const;
  /// Square of the gradient's size in the metric of least movement: translations over the extent, rotations in radians.
  double free_response(const std::vector<double>& gradient) const;

  /// "the ANGLE of HINGE 3", or its SPEED.
  std::string name(const InitialCoordinate& coordinate) const;
  /// "30 deg"
  std::string shown(const InitialCoordinate& coordinate, double value) const;

 private:
  double channel(const Configuration& c, const InitialCoordinate& coordinate, std::size_t behind) const;
  const Named& named(const InitialCoordinate& coordinate) const;

  const Assembler& assembler_;
};

}  // namespace engrane::solve
