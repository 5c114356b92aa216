// SPDX-License-Identifier: BSD-3-Clause
#include "base/dimension.hpp"

#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "base/text.hpp"

namespace engrane {

namespace {

struct NamedUnit {
  std::string_view name;
  double factor;
};

constexpr std::array<NamedUnit, 7> length_units{
    {{"m", 1}, {"mm", 1e-3}, {"cm", 1e-2}, {"km", 1e3}, {"um", 1e-6}, {"in", 0.0254}, {"ft", 0.3048}}};
constexpr std::array<NamedUnit, 6> mass_units{
    {{"kg", 1}, {"g", 1e-3}, {"t", 1e3}, {"lbm", 0.45359237}, {"slug", 14.593903}, {"lbf·s²/in", 175.126835}}};
constexpr std::array<NamedUnit, 4> time_units{{{"s", 1}, {"ms", 1e-3}, {"min", 60}, {"h", 3600}}};
constexpr std::array<NamedUnit, 5> force_units{{{"N", 1}, {"kN", 1e3}, {"MN", 1e6}, {"mN", 1e-3}, {"lbf", 4.4482216152605}}};

/// Name of the unit with this factor. The tolerance allows for factors given with few digits.
template <std::size_t N>
std::string unit_name(const std::array<NamedUnit, N>& units, double factor) {
  for (const NamedUnit& unit : units)
    if (std::abs(factor - unit.factor) <= 1e-4 * unit.factor) return std::string(unit.name);
  return {};
}

struct Factor {
  std::string name;
  int exponent;
};

std::string superscript(int exponent) {
  static constexpr std::array<std::string_view, 10> digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  if (exponent == 1) return {};
  std::string result;
  for (char c : std::to_string(exponent)) result += digits[static_cast<std::size_t>(c - '0')];
  return result;
}

/// `N·m·s/rad`: positive exponents first, then negative ones as divisors.
std::string product(const std::vector<Factor>& factors) {
  std::string above;
  std::string below;
  for (const Factor& factor : factors) {
    if (factor.exponent > 0) above += (above.empty() ? "" : "·") + factor.name + superscript(factor.exponent);
    if (factor.exponent < 0) below += "/" + factor.name + superscript(-factor.exponent);
  }
  if (above.empty() && below.empty()) return {};
  return (above.empty() ? "1" : above) + below;
}

/// Engineers read a stiffness as force per length, not as mass per time squared.
bool reads_as_force(Dimension d) { return d.mass == 1 && d.time < 0; }

std::vector<Factor> factors_of(Dimension d, const std::string& force, const std::string& length, const std::string& mass,
                               const std::string& time) {
  if (reads_as_force(d)) return {{force, 1}, {length, d.length - 1}, {time, d.time + 2}, {"rad", d.angle}};
  return {{mass, d.mass}, {length, d.length}, {"rad", d.angle}, {time, d.time}};
}

}  // namespace

double UnitSystem::to_si(Dimension d) const {
  return std::pow(length, d.length) * std::pow(mass, d.mass) * std::pow(time, d.time);
}

std::string UnitSystem::label(Dimension d) const {
  if (d == dimension::none) return {};
  if (d == dimension::angle) return "rad";
  if (!given) return "[" + product(factors_of(d, "force", "length", "mass", "time")) + "]";

  const std::string length_name = unit_name(length_units, length);
  const std::string mass_name = unit_name(mass_units, mass);
  const std::string time_name = unit_name(time_units, time);
  const std::string force_name = unit_name(force_units, length * mass / (time * time));
  const bool as_force = reads_as_force(d) && !force_name.empty();
  const bool named = (length_name.empty() ? d.length == (as_force ? 1 : 0) : true) &&
                     (as_force || !mass_name.empty() || d.mass == 0) && (!time_name.empty() || d.time == (as_force ? -2 : 0));
  if (!named) return format_number(to_si(d)) + " SI";
  if (as_force) {
    if (d.length == -1 && d.time == -2 && d.angle == 0 && force_name == "N") {  // pressure units have names of their own
      if (length_name == "m") return "Pa";
      if (length_name == "mm") return "MPa";
    }
    return product(factors_of(d, force_name, length_name, mass_name, time_name));
  }
  return product({{mass_name, d.mass}, {length_name, d.length}, {"rad", d.angle}, {time_name, d.time}});
}

}  // namespace engrane
