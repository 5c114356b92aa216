// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "model/function.hpp"

namespace engrane::elements::membranes {

/// p V^γ = c f(t), in an atmosphere of constant pressure. γ must be 1 if f is not constant.
struct GasLaw {
  double amount = 0;                   ///< c
  double gamma = 1;                    ///< γ
  double ambient = 0;                  ///< p₀
  double rest = 0;                     ///< reference pressure of the isothermal energy (γ = 1)
  const Function* function = nullptr;  ///< f; nullptr: 1

  struct Pressure {
    double value = 0,
           by_volume = 0;  ///< absolute pressure and its derivative; NaN if the volume is not positive or c f is negative
  };
  Pressure pressure(double volume, double time) const;
  /// Potential energy of the gas and the atmosphere.
  double energy(double volume, double time) const;
  /// Power supplied by filling: ∂energy/∂t at constant volume.
  double filling(double volume, double time) const;
  /// Work of filling from one amount c f to another at constant volume.
  double work_of_filling(double from, double to, double volume) const;
  double amount_at(double time) const { return amount * (function ? function->at(time).f : 1); }
};

}  // namespace engrane::elements::membranes
