// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "model/element.hpp"

namespace engrane {

/// An element that is filled as a function of time. The power of filling jumps where the function has a corner, and the content
/// does not: the work of filling is computed from contents and volumes at the ends of steps, wherever corners lie.
class Filled {
 public:
  struct Filling {
    double content = 0;  ///< of the dimension of an energy: the pressure is content / volume
    double volume = 0;
    double growth = 0;  ///< rate of the volume over the volume
    double power = 0;   ///< part of energies().external
  };
  virtual Filling filling(const State& state) const = 0;
  /// Work of filling from one content to another at constant volume.
  virtual double work_of_filling(double from, double to, double volume) const = 0;

 protected:
  ~Filled() = default;
};

}  // namespace engrane
