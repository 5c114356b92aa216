// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "deck/schema/schema.hpp"
#include "model/registry.hpp"

namespace engrane::elements::structural {

/// `.CLM GROUP "flank" PRE V p [DEAD] [NF f]`: pressure on all faces of groups.
struct GroupPressureData {
  std::vector<std::string> groups;
  double pressure = 0;  ///< positive against the outward normal
  int function = 0;
  bool dead = false;
};

ElementType group_pressure_type();

}  // namespace engrane::elements::structural
