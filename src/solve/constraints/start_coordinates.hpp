// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "assembly/assembler.hpp"

namespace engrane::solve {

/// Joint coordinates whose initial values or speeds the deck gives, as further constraints at the start only. Nothing is
/// assembled for them: they are read from the channels of their elements, and their gradients from the channels of their rates,
/// which are linear in velocities.
class StartCoordinates {
 public:
  explicit StartCoordinates(const Assembler& assembler) : assembler_(assembler) {}

  /// A coordinate (or its rate) and its wanted value.
  struct Wanted {
    const InitialCoordinate* coordinate;
    double value;
  };
  /// Joint coordinates that the deck wants: positions, or velocities.
  std::vector<Wanted> wanted(bool velocity) const;

  double value(const Configuration& c, const InitialCoordinate& coordinate) const { return channel(c, coordinate, 0); }
  double rate(const Configuration& c, const InitialCoordinate& coordinate) const { return channel(c, coordinate, 1); }
  /// Deviations from the wanted values, in their own units.
  std::vector<double> missed(const Configuration& c, const std::vector<Wanted>& all) const;
  /// Reference of a deviation: the extent, or a radian, plus the magnitude of the value.
  double size(const Wanted& one) const;
  /// Derivative of the coordinate with respect to every equation's unknown; 0 for multipliers.
  std::vector<double> gradient(const Configuration& c, const InitialCoordinate& coordinate) const;
  /// Squared length of the gradient in the metric of least movement: translations over the extent, rotations in radians.
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
