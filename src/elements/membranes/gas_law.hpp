// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "model/function.hpp"

namespace engrane::elements::membranes {

/// p V^γ = c f(t), in an atmosphere of constant pressure; γ is 1 where f is not constant.
struct GasLaw {
  double amount = 0;                   ///< c
  double gamma = 1;                    ///< γ
  double ambient = 0;                  ///< p₀
  double rest = 0;                     ///< pressure at which a gas that keeps its temperature has no energy
  const Function* function = nullptr;  ///< f; none: 1

  struct Pressure {
    double value = 0,
           by_volume = 0;  ///< absolute, and its derivative; not a number where the volume is not above zero or c f below it
  };
  Pressure pressure(double volume, double time) const;
  /// What the gas and the atmosphere can give back.
  double energy(double volume, double time) const;
  /// Power of what fills the gas: the derivative of the energy by the time alone.
  double filling(double volume, double time) const;

 private:
  double amount_at(double time) const { return amount * (function ? function->at(time).f : 1); }
};

}  // namespace engrane::elements::membranes
