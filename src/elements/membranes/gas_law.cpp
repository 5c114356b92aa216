// SPDX-License-Identifier: BSD-3-Clause
#include "elements/membranes/gas_law.hpp"

#include <cmath>
#include <limits>

namespace engrane::elements::membranes {

GasLaw::Pressure GasLaw::pressure(double volume, double time) const {
  const double c = amount_at(time);
  if (!(volume > 0 && c >= 0)) return {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
  const double p = c / (gamma == 1 ? volume : std::pow(volume, gamma));
  return {p, -gamma * p / volume};
}

/// U with −∂U/∂V = p − p₀: p V/(γ − 1) + p₀ V for an adiabatic gas, and for an isothermal one the free energy
/// p V (ln(p/rest) − 1) + p₀ V.
double GasLaw::energy(double volume, double time) const {
  const double p = pressure(volume, time).value;
  if (gamma != 1) return p * volume / (gamma - 1) + ambient * volume;
  return ambient * volume + (p == 0 ? 0.0 : p * volume * (std::log(p / rest) - 1));
}

double GasLaw::filling(double volume, double time) const {
  if (!function) return 0;
  const double p = pressure(volume, time).value;
  return p == 0 ? 0.0 : amount * function->at(time).d1 * std::log(p / rest);
}

/// ∫ ln(p/rest) d(p V) = [p V (ln(p/rest) − 1)], the difference of the free energies.
double GasLaw::work_of_filling(double from, double to, double volume) const {
  if (from == to) return 0;
  const auto energy_of = [this, volume](double content) {
    return content == 0 ? 0.0 : content * (std::log(content / (volume * rest)) - 1);
  };
  return energy_of(to) - energy_of(from);
}

}  // namespace engrane::elements::membranes
