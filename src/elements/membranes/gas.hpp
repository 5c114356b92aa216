// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "model/registry.hpp"

namespace engrane::elements::membranes {

/// Card of an enclosed gas. `GAS GROUP "balloon" P p [GAMMA g] | MASS m [NF f] R r TEMP T  [AMBIENT p0] [CUT n… AT x y z]`
struct GasData {
  std::vector<std::string> groups;  ///< of membranes
  std::optional<double> pressure;   ///< absolute, of the reference configuration
  double gamma = 1;                 ///< exponent of the volume
  std::optional<double> mass, constant, temperature;
  int function = 0;  ///< function of time that multiplies the mass
  double ambient = 0;
  std::vector<double> cuts;  ///< normals of planes, three numbers each
  std::array<double, 3> at{};
};

/// GAS: gas enclosed by membranes, with a uniform pressure that follows from its volume.
ElementType gas_type();

}  // namespace engrane::elements::membranes
